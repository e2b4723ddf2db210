"""Pane of the picture: the simulated one, and a photo beside it or over it."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QSlider,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from occ_gui.picture.before_wipe import BeforeWipe
from occ_gui.picture.photo_overlay import MODES, PhotoOverlay
from occ_gui.picture.picture_pane import PicturePane
from occ_gui.picture.placement import Placement
from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.widgets.keyed_combo_box import KeyedComboBox
from occ_model.arrays import ByteArray
from occ_model.photo.reading.load import Photo

_GAINS = (1, 2, 4, 8)
_FIRST_GAIN = 4
"""Without a factor, differences of a few grey levels would look black."""


class ImageView(QWidget):
    """The simulated picture with the decoder's region, and the photo beside or over it."""

    mode_chosen = Signal(str)
    """The way of showing the photo that the user chose, one of MODES."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._photo: Photo | None = None
        self._shown: ByteArray | None = None
        self._mode = MODES[0]
        self.simulation = PicturePane(self.tr("Simulated picture"))
        self.photo = PicturePane(self.tr("Photo"))
        self.overlay = PhotoOverlay(self.simulation.box)
        self.before = BeforeWipe(self.simulation.box)
        self.simulation.caption_row.addWidget(self.before.controls)
        # The tops of both pictures are aligned.
        self.photo.caption.setMinimumHeight(self.before.controls.sizeHint().height())
        panes = QSplitter(Qt.Orientation.Horizontal)
        panes.addWidget(self.simulation)
        panes.addWidget(self.photo)
        panes.setChildrenCollapsible(False)
        panes.setSizes([500, 500])
        self._make_controls()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.addWidget(panes, 1)
        layout.addWidget(self._row)
        self._arrange()

    def _make_controls(self) -> None:
        self.mode = KeyedComboBox(
            self.tr("How photo and simulation are shown"), self._mode_meanings(), self._mode_words()
        )
        # Its words must not be cut off: some begin alike.
        self.mode.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.mode.chosen.connect(self.mode_chosen)
        self.opacity = QSlider(Qt.Orientation.Horizontal)
        self.opacity.setRange(0, 100)
        self.opacity.setValue(50)
        self.opacity.setMinimumWidth(60)
        self.opacity.setAccessibleName(self.tr("Opacity of the photo"))
        self.opacity.setToolTip(self.tr("Opacity of the photo over the simulation, in percent."))
        self.opacity.valueChanged.connect(lambda percent: self.overlay.set_opacity(percent / 100))
        self.gain = KeyedComboBox(
            self.tr("Factor of the difference"),
            self.tr(
                "The factor by which the difference in grey levels is multiplied, up to white."
            ),
            {str(gain): f"× {gain}" for gain in _GAINS},  # noqa: RUF001 - the sign for times
        )
        self.gain.show_key(str(_FIRST_GAIN))
        self.overlay.difference.set_gain(_FIRST_GAIN)
        self.gain.chosen.connect(self._set_gain)
        self._row = QWidget()
        layout = QHBoxLayout(self._row)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.mode, 1)
        layout.addWidget(self.opacity, 2)
        layout.addWidget(self.gain, 2)

    def _mode_words(self) -> dict[str, str]:
        return {
            "beside": self.tr("Side by side"),
            "blend": self.tr("Blended"),
            "split": self.tr("Split"),
            "difference": self.tr("Difference"),
        }

    def _mode_meanings(self) -> str:
        return self.tr(
            "Side by side: each picture in its own view.\n"
            "Blended: the photo over the simulation, with the opacity of the slider.\n"
            "Split: the simulation above a line that can be dragged, the photo below it; matching "
            "stripes continue across it.\n"
            "Difference: the absolute difference in grey levels, black where both are equal; "
            "averaged over each pixel of the screen."
        )

    def _captions(self) -> dict[str, str]:
        return {
            "beside": self.tr("Simulated picture"),
            "blend": self.tr("Photo over the simulated picture"),
            "split": self.tr("Simulation above the line, photo below"),
            "difference": self.tr("Difference × {gain}: black where both are equal").format(  # noqa: RUF001 - the sign for times
                gain=self.gain.key()
            ),
        }

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the previous ones."""
        if (
            snapshot.frame.image is not self._shown
        ):  # the picture may have been shown before it was decoded
            self.show_picture(Picture(snapshot.frame, ()))
        self.simulation.show_region(snapshot.decoded.region)

    def show_picture(self, picture: Picture) -> None:
        """Show this picture in place of the previous one; the region decoded from that stays."""
        self._shown = picture.frame.image
        self.simulation.show_picture(self._shown, picture.halves)
        self.overlay.set_simulated(self._shown)

    def show_photo(self, photo: Photo | None) -> None:
        """Show this photo in place of the previous one, or none."""
        self._photo = photo
        if photo is not None:
            self.photo.show_picture(photo.image)
            turned = self.tr(", its lines shown as columns") if photo.turned else ""
            self.photo.caption.set_full_text(
                self.tr("Photo {name}{turned}").format(name=photo.path.name, turned=turned)
            )
        self.overlay.set_photo(None if photo is None else photo.image)
        self._arrange()

    def show_placement(self, placement: Placement) -> None:
        """Place the photo on the simulated picture."""
        self.overlay.set_placement(placement)

    def set_mode(self, mode: str) -> None:
        """Show the photo beside the simulated picture or on it, by one of MODES."""
        self._mode = mode
        self.mode.show_key(mode)
        self.overlay.set_mode(mode)
        self._arrange()

    def _set_gain(self, gain: str) -> None:
        self.overlay.difference.set_gain(int(gain))
        self._arrange()

    def fit(self) -> None:
        """Zoom out until both pictures are seen whole."""
        self.simulation.fit()
        self.photo.fit()

    def _arrange(self) -> None:
        there = self._photo is not None
        self.photo.setVisible(there and self._mode == "beside")
        self._row.setVisible(there)
        self.opacity.setVisible(self._mode == "blend")
        self.gain.setVisible(self._mode == "difference")
        caption = self._captions()[self._mode if there else MODES[0]]
        self.simulation.caption.set_full_text(caption)
