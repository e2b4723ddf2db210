"""A choice among a few words, each standing for a key."""

from collections.abc import Mapping

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QSizePolicy, QWidget

from occ_gui.widgets.event_filters import keep_wheel_for_scrolling


class KeyedComboBox(QComboBox):
    """Shows one of some words and tells which the user chooses.

    Parameters
    ----------
    name
        What is chosen, for those who do not see it.
    meaning
        What it means, as a tooltip.
    words
        The words, by the keys that they stand for.
    parent
        The parent widget.
    """

    chosen = Signal(str)
    """The key that the user has chosen."""

    def __init__(
        self, name: str, meaning: str, words: Mapping[str, str], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        for key, word in words.items():
            self.addItem(word, key)
        self.setAccessibleName(name)
        self.setToolTip(meaning)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        keep_wheel_for_scrolling(self)
        self.activated.connect(lambda: self.chosen.emit(self.key()))

    def key(self) -> str:
        """Give the key of the word that is shown."""
        return str(self.currentData())

    def show_key(self, key: str) -> None:
        """Show the word that stands for a key, without telling of it."""
        self.setCurrentIndex(self.findData(key))
