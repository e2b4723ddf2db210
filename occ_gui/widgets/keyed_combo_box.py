"""Keyed combo box: a choice among a few words, each with a key."""

from collections.abc import Mapping

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QSizePolicy

from occ_gui.widgets.event_filters import keep_wheel_for_scrolling

_POPUP_MARGIN = 36  # pixels for margins and scroll bar of the list


class KeyedComboBox(QComboBox):
    """A combo box that emits the key of the chosen word; if fixed, it is as wide as its words."""

    chosen = Signal(str)

    def __init__(
        self, name: str, meaning: str, words: Mapping[str, str], *, is_fixed: bool = False
    ) -> None:
        super().__init__()
        for key, word in words.items():
            self.addItem(word, key)
        self.setAccessibleName(name)
        self.setToolTip(meaning)
        width, adjust = QSizePolicy.Policy, QComboBox.SizeAdjustPolicy
        self.setSizePolicy(width.Fixed if is_fixed else width.Expanding, width.Fixed)
        self.setSizeAdjustPolicy(
            adjust.AdjustToContents if is_fixed else adjust.AdjustToMinimumContentsLengthWithIcon
        )
        keep_wheel_for_scrolling(self)
        self.activated.connect(lambda: self.chosen.emit(self.key()))

    def showPopup(self) -> None:  # noqa: N802 - Qt's name
        """Open the list as wide as its widest word, even if the box is narrower."""
        words = (self.itemText(place) for place in range(self.count()))
        widest = max(map(self.fontMetrics().horizontalAdvance, words), default=0)
        self.view().setMinimumWidth(widest + _POPUP_MARGIN)
        super().showPopup()

    def key(self) -> str:
        return str(self.currentData())

    def show_key(self, key: str) -> None:
        self.setCurrentIndex(self.findData(key))
