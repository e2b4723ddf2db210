"""Pane of the picture: the simulated picture, and a photo beside it or over it."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QSlider, QSplitter, QVBoxLayout, QWidget

from occ_gui.core.store import Store
from occ_gui.picture.before_wipe import BeforeWipe
from occ_gui.picture.photo_overlay import PhotoOverlay
from occ_gui.picture.picture_pane import PicturePane
from occ_gui.shell.feature import PiecesPane
from occ_gui.shell.results import of_picture
from occ_gui.simulation.snapshot import Picture, Reading, Snapshot
from occ_gui.values.choices import OVERLAYS, Placement
from occ_gui.widgets.building import KeyedComboBox, fill
from occ_model.photo.reading.load import Photo
from occ_model.results.frame import PICTURES, Frame

_GAINS = (1, 2, 4, 8)
_CAPTION_SPACING = 8  # pixels between the controls of one picture and the caption of the other
_FIRST_GAIN = 4  # without a factor, differences of a few grey levels would look black

_MODES = {
    "beside": "Side by side",
    "blend": "Blended",
    "split": "Split",
    "difference": "Difference",
}
_MODE_MEANINGS = (
    "Side by side: each picture in its own view.\n"
    "Blended: the photo over the simulation, with the opacity of the slider.\n"
    "Split: the simulation above a line that can be dragged, the photo below it; matching "
    "stripes continue across it.\n"
    "Difference: the absolute difference in grey levels, black where both are equal; "
    "averaged over each pixel of the screen."
)


class ImageView(QWidget):
    """The simulated picture with the decoder's region, and the photo beside or over it."""

    mode_chosen = Signal(str)  # how the photo is to be shown, one of OVERLAYS
    picture_chosen = Signal(str)  # the kind of picture that is shown from now on, one of PICTURES

    def __init__(self) -> None:
        super().__init__()
        self.shown_photo: Photo | None = None
        self.frame: Frame | None = None
        self._mode = OVERLAYS[0]
        self.picture_kind = PICTURES[0]
        self.simulation = PicturePane("Simulated picture")
        self.photo = PicturePane("Photo")
        self.overlay = PhotoOverlay(self.simulation.box)
        self.before = BeforeWipe(self.simulation.box)
        self._make_switch()
        # Room for a few letters of the title, even beside a photo in a small window.
        self.simulation.caption.setMinimumWidth(self.fontMetrics().horizontalAdvance("Camera"))
        self.simulation.caption_row.addWidget(self.switch)
        self.simulation.caption_row.addWidget(self.before.controls)
        self.photo.caption.setContentsMargins(_CAPTION_SPACING, 0, 0, 0)
        # The tops of both pictures are aligned.
        self.photo.caption.setMinimumHeight(
            max(part.sizeHint().height() for part in (self.switch, self.before.controls))
        )
        panes = QSplitter(Qt.Orientation.Horizontal)
        panes.addWidget(self.simulation)
        panes.addWidget(self.photo)
        panes.setChildrenCollapsible(False)
        panes.setSizes([500, 500])
        self._make_controls()
        fill(QVBoxLayout(self), (panes, 1), self._controls_row, margins=4)
        self._arrange()

    def _make_switch(self) -> None:
        self.switch = KeyedComboBox(
            "Whose picture is shown",
            "Camera: the picture as it comes from the camera; photos are compared with it.\n"
            "Receiver: the picture after the receiver's enhancement, which it reads.",
            {"camera": "Camera", "receiver": "Receiver"},
            is_fixed=True,
        )
        self.switch.chosen.connect(self.choose_picture)

    def _make_controls(self) -> None:
        self.mode = KeyedComboBox("How photo and simulation are shown", _MODE_MEANINGS, _MODES)
        # The words must not be cut off, because some begin alike.
        self.mode.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.mode.chosen.connect(self.mode_chosen)
        self.opacity = QSlider(Qt.Orientation.Horizontal)
        self.opacity.setRange(0, 100)
        self.opacity.setValue(50)
        self.opacity.setMinimumWidth(60)
        self.opacity.setAccessibleName("Opacity of the photo")
        self.opacity.setToolTip("Opacity of the photo over the simulation, in percent.")
        self.opacity.valueChanged.connect(lambda percent: self.overlay.set_opacity(percent / 100))
        self.gain = KeyedComboBox(
            "Factor of the difference",
            "The factor by which the difference in grey levels is multiplied.",
            {str(gain): f"× {gain}" for gain in _GAINS},  # noqa: RUF001 - the sign for times
        )
        self.gain.show_key(str(_FIRST_GAIN))
        self.gain.setMinimumContentsLength(len(f"× {max(_GAINS)}"))  # noqa: RUF001
        self.overlay.difference.set_gain(_FIRST_GAIN)
        self.gain.chosen.connect(self._set_gain)
        self._controls_row = QWidget()
        row = QHBoxLayout(self._controls_row)
        fill(row, self.mode, (self.opacity, 2), self.gain, (None, 1), margins=0)

    def _caption(self) -> str:
        frame, mode = self.frame, self._mode
        picture = "Simulated picture"
        if frame is not None:
            picture = frame.picture_title(self.picture_kind)
            if frame.rows_step > 1:
                picture = f"Draft, one row in {frame.rows_step}: {picture}"
        if self.shown_photo is None:
            return picture
        if mode == "beside":  # the combo box beside it names the kind of picture
            is_draft = frame is not None and frame.rows_step > 1
            return "Simulated, draft" if is_draft else "Simulated"
        if mode == "blend":
            return f"Photo over: {picture}"
        if mode == "split":
            return f"{picture}, above the line; photo below"
        picture = picture[:1].lower() + picture[1:]
        return f"Difference × {self.gain.key()}: photo and {picture}; black where equal"  # noqa: RUF001

    def show_snapshot(self, snapshot: Snapshot) -> None:
        if snapshot.frame is not self.frame:  # else it was already shown, before it was decoded
            self.show_picture(Picture(snapshot.frame))
        self.show_reading(snapshot)

    def show_reading(self, reading: Reading) -> None:
        self.simulation.show_region(reading.region)

    def show_picture(self, picture: Picture) -> None:
        """Show a picture in place of the previous one; the region stays until the next reading."""
        if not picture.view_as(self.picture_kind).is_whole:
            return  # the draft stays until all rows are there
        self.frame = frame = picture.frame
        image = frame.picture(self.picture_kind)
        self.simulation.show_picture(image, frame.rows_step)
        if frame.rows_step == 1:
            self.overlay.set_simulated(image)
        elif self.shown_photo is not None:
            full_image = np.repeat(image, frame.rows_step, axis=0)[: frame.scene.camera.rows]
            self.overlay.set_simulated(full_image)
        self._show_caption()

    def rows_per_pixel(self) -> float:
        return self.simulation.rows_per_pixel()

    def choose_picture(self, picture_kind: str) -> None:
        if picture_kind == self.picture_kind:
            return
        self.picture_kind = picture_kind
        self.switch.show_key(picture_kind)
        self.before.choose_picture(picture_kind)
        if self.frame is not None:
            self.show_picture(Picture(self.frame))
        self.picture_chosen.emit(picture_kind)

    def levels_at(self, column: int, row: int) -> dict[str, int] | None:
        """Return the grey level of a pixel in each kind of picture; None outside the picture."""
        frame = self.frame
        if frame is None:
            return None
        camera = frame.scene.camera
        if not (0 <= row < camera.rows and 0 <= column < camera.columns):
            return None
        row //= frame.rows_step
        return {kind: int(frame.picture(kind)[row, column]) for kind in PICTURES}

    def show_photo(self, photo: Photo | None) -> None:
        self.shown_photo = photo
        if photo is not None:
            self.photo.show_picture(photo.image)
            turned = ", its lines shown as columns" if photo.turned else ""
            self.photo.caption.set_full_text(f"Photo {photo.path.name}{turned}")
        self.overlay.set_photo(None if photo is None else photo.image)
        self._arrange()

    def show_placement(self, placement: Placement) -> None:
        self.overlay.set_placement(placement)

    def set_mode(self, mode: str) -> None:
        """Set how the photo is shown, one of OVERLAYS."""
        self._mode = mode
        self.mode.show_key(mode)
        self.overlay.set_mode(mode)
        self._arrange()

    def _set_gain(self, gain: str) -> None:
        self.overlay.difference.set_gain(int(gain))
        self._arrange()

    def fit(self) -> None:
        """Zoom out until both pictures are entirely visible."""
        self.simulation.fit()
        self.photo.fit()

    def _arrange(self) -> None:
        has_photo = self.shown_photo is not None
        self.photo.setVisible(has_photo and self._mode == "beside")
        self._controls_row.setVisible(has_photo)
        self.opacity.setVisible(self._mode == "blend")
        self.gain.setVisible(self._mode == "difference")
        self._show_caption()

    def _show_caption(self) -> None:
        caption = self._caption()
        self.simulation.caption.set_full_text(caption)
        self.simulation.graphics.setAccessibleName(caption)


class PicturesPane(PiecesPane):
    def __init__(self, store: Store) -> None:
        self.view = view = ImageView()
        super().__init__(
            view, view.choose_picture, view.set_mode, view.before.show_before, view.show_picture,
            view.show_snapshot, view.show_reading,
        )  # fmt: skip
        self.made_of = {view.simulation: of_picture}
        view.picture_chosen.connect(
            lambda kind: store.put(replace(store.workspace, picture_kind=kind))
        )
        view.mode_chosen.connect(lambda mode: store.put(replace(store.workspace, overlay=mode)))
