"""Facts about the photo: name, size, camera and settings, and the options for loading it."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from occ_gui.widgets.building import fill, push_button
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.keyed_combo_box import KeyedComboBox
from occ_gui.widgets.plain_text import LONGEST_TEXT, in_tool_tip
from occ_model.errors import one_line
from occ_model.photo.reading.choices import CHANNELS
from occ_model.photo.reading.load import Photo
from occ_model.scene.parameters import quantity

_PREFIXES = {"exposure_time": "", "iso": "ISO ", "f_number": "f/"}
"""Prefixes of the settings that cameras record, by the names of the scene's parameters."""


class PhotoFacts(QWidget):
    settings_asked = Signal()  # the user applies the camera's recorded settings to the scene

    channel_chosen = Signal(str)
    scan_axis_chosen = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.name = ElidedLabel(how=Qt.TextElideMode.ElideMiddle)
        font = self.name.font()
        font.setBold(True)
        self.name.setFont(font)
        self.size_line, self.notes = ElidedLabel(), ElidedLabel()
        self.use_settings = push_button(
            "&Use this photo's settings",
            "Put the exposure time, ISO speed and f-number that the camera recorded into the "
            "scene, as one step that can be undone.",
            self.settings_asked,
        )
        self.channel = KeyedComboBox(
            "Channel",
            "The colour channel searched for stripes; a grey photo has only one.",
            dict(zip(CHANNELS, CHANNELS, strict=True)),
        )
        self.channel.chosen.connect(self.channel_chosen)
        self.scan_axis = KeyedComboBox(
            "Scanned",
            "The direction in which the shutter scanned: by columns or by lines of the file. "
            "Automatic: across the stripes.",
            {"auto": "automatic", "columns": "by columns", "lines": "by lines"},
        )
        self.scan_axis.chosen.connect(self.scan_axis_chosen)
        notes = fill(QHBoxLayout(), (self.notes, 1), self.use_settings)
        choices = fill(
            QHBoxLayout(), QLabel("Channel"), (self.channel, 1), QLabel("Scanned"),
            (self.scan_axis, 1),
        )  # fmt: skip
        fill(QVBoxLayout(self), self.name, self.size_line, notes, choices, margins=0, spacing=3)

    def show_photo(self, photo: Photo) -> None:
        self.name.set_full_text(photo.path.name)
        self.name.setToolTip(in_tool_tip(one_line(str(photo.path), LONGEST_TEXT)))
        rows, columns = photo.image.shape
        width, height = (rows, columns) if photo.turned else (columns, rows)
        is_mean = photo.channel in {"grey", "luma"}
        channel = photo.channel if is_mean else f"{photo.channel} channel"
        facts = [photo.camera] if photo.camera else []
        facts += [f"{width} x {height} px", channel]
        facts += ["turned"] if photo.turned else []
        facts += ["RAW: gamma 1"] if photo.is_linear else []
        self.size_line.set_full_text(", ".join(facts))
        recorded = [
            prefix + quantity(name).format(value)
            for name, prefix in _PREFIXES.items()
            if (value := getattr(photo, name)) is not None
        ]
        self.notes.set_full_text(", ".join(recorded) or "No settings recorded.")
        self.use_settings.setEnabled(bool(recorded))

    def show_load_options(self, channel: str, scan_axis: str) -> None:
        self.channel.show_key(channel)
        self.scan_axis.show_key(scan_axis)
