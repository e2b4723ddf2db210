"""Facts about the photo: name, size, camera and settings, and the options of reading it."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.keyed_combo_box import KeyedComboBox
from occ_gui.widgets.plain_text import LONGEST, in_tool_tip
from occ_model.errors import one_line
from occ_model.photo.reading.load import Photo
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS

_PREFIXES = {"exposure_time": "", "iso": "ISO ", "f_number": "f/"}
"""Prefixes of the settings that cameras record, by the names of the scene's parameters."""


class PhotoFacts(QWidget):
    """The photo's name, size, camera and settings, and the choice of channel and scan axis."""

    settings_asked = Signal()
    """The user puts the settings that the camera recorded into the scene."""

    channel_chosen = Signal(str)
    scan_axis_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.name = ElidedLabel(how=Qt.TextElideMode.ElideMiddle)
        font = self.name.font()
        font.setBold(True)
        self.name.setFont(font)
        self.size_line = ElidedLabel()
        self.notes = ElidedLabel()
        self.use_settings = QPushButton("&Use this photo's settings")
        self.use_settings.setToolTip(
            "Put the exposure time, ISO speed and f-number that the camera recorded into the "
            "scene, as one step that can be undone."
        )
        self.use_settings.clicked.connect(self.settings_asked)
        self.channel = KeyedComboBox(
            "Channel",
            "The colour channel searched for stripes; a grey photo has only one.",
            {
                "brightest": "brightest",
                "luma": "luma",
                "red": "red",
                "green": "green",
                "blue": "blue",
            },
        )
        self.channel.chosen.connect(self.channel_chosen)
        self.scan_axis = KeyedComboBox(
            "Scanned",
            (
                "The direction in which the shutter scanned: by columns or by lines of the file; "
                "automatic: across the stripes."
            ),
            {
                "auto": "automatic",
                "columns": "by columns",
                "lines": "by lines",
            },
        )
        self.scan_axis.chosen.connect(self.scan_axis_chosen)
        self._lay_out()

    def _lay_out(self) -> None:
        notes = QHBoxLayout()
        notes.addWidget(self.notes, 1)
        notes.addWidget(self.use_settings)
        choices = QHBoxLayout()
        for text, control in (
            ("Channel", self.channel),
            ("Scanned", self.scan_axis),
        ):
            choices.addWidget(QLabel(text))
            choices.addWidget(control, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(3)
        layout.addWidget(self.name)
        layout.addWidget(self.size_line)
        layout.addLayout(notes)
        layout.addLayout(choices)

    def show_photo(self, photo: Photo) -> None:
        """Show the facts about a photo."""
        self.name.set_full_text(photo.path.name)
        self.name.setToolTip(in_tool_tip(one_line(str(photo.path), LONGEST)))
        rows, columns = photo.image.shape
        width, height = (rows, columns) if photo.turned else (columns, rows)
        size = f"{width} x {height} px, {self._channel_word(photo.channel)}"
        if photo.turned:
            size += ", turned"
        if photo.is_linear:
            size += ", RAW: gamma 1"
        camera = f"{photo.camera}, " if photo.camera else ""
        self.size_line.set_full_text(camera + size)
        recorded = self._recorded(photo)
        self.notes.set_full_text(", ".join(recorded) or "No settings recorded.")
        self.use_settings.setEnabled(bool(recorded))

    def show_reading(self, channel: str, scan_axis: str) -> None:
        """Show the options of reading without emitting a signal."""
        self.channel.show_key(channel)
        self.scan_axis.show_key(scan_axis)

    def _channel_word(self, channel: str) -> str:
        return channel if channel in {"grey", "luma"} else f"{channel} channel"

    def _recorded(self, photo: Photo) -> list[str]:
        recorded = []
        for name, prefix in _PREFIXES.items():
            value, declared = getattr(photo, name), PARAMETERS[name]
            if value is not None and isinstance(declared, Quantity):
                recorded.append(prefix + declared.format(value))
        return recorded
