"""Controllers of the photo, connected with the panes: reading, placing, comparing, matching."""

from functools import partial

from pyqtgraph.GraphicsScene.mouseEvents import MouseClickEvent
from PySide6.QtCore import QObject

from occ_gui.photo.chip_controller import ChipController
from occ_gui.photo.comparison_controller import ComparisonController
from occ_gui.photo.kept_photo import KeptPhoto
from occ_gui.photo.lamp_controller import LampController
from occ_gui.photo.lamp_outlines import LampOutlines
from occ_gui.photo.many.many_controller import ManyPhotosController
from occ_gui.photo.match_choice import MatchChoice
from occ_gui.photo.match_controller import MatchController
from occ_gui.photo.photo_controller import PhotoController, PhotoReading
from occ_gui.photo.photo_view import PhotoView
from occ_gui.picture.image_view import ImageView
from occ_gui.picture.photo_overlay import MODES
from occ_gui.picture.placement import Placement, PlacementStore
from occ_gui.profile.profile_view import ProfileView
from occ_gui.scene.scene_store import SceneStore
from occ_model.photo.reading.load import Photo
from occ_model.results import Lamp, Match, Region


class PhotoWiring(QObject):
    """Connects the controllers of a photo with the panes that show it.

    Parameters
    ----------
    scenes
        The scene that a photo is matched with.
    image, profile, pane
        The panes.
    """

    def __init__(
        self, scenes: SceneStore, image: ImageView, profile: ProfileView, pane: PhotoView
    ) -> None:
        super().__init__()
        self._image = image
        self._pane = pane
        self.verdict = pane.verdict
        self.placements = PlacementStore()
        self.comparison = ComparisonController(self.placements, profile)
        self.matching = MatchController(scenes, pane)
        self.many = ManyPhotosController(scenes, pane.many)
        self.chips = ChipController(profile.chips)
        self.outlines = LampOutlines(image.photo.box)
        self.lamps = LampController((pane.lamps, self.outlines))
        self.photos = PhotoController(
            [image, pane, self.comparison, self.matching, self.chips, self.lamps]
        )
        self._connect_lamps()
        self.placements.changed.connect(self._show_placement)
        image.overlay.placed.connect(self.placements.move)
        pane.placement.placed.connect(self.placements.move)
        pane.placement.reset_asked.connect(self.placements.reset)
        pane.placement.moving_chosen.connect(self._let_move)
        image.mode_chosen.connect(image.set_mode)
        profile.enhanced_chosen.connect(self.comparison.set_enhanced)
        pane.facts.channel_chosen.connect(self.photos.take_channel)
        pane.facts.scan_axis_chosen.connect(self.photos.scan_along)
        pane.facts.settings_asked.connect(self.matching.use_notes)
        pane.form.certain_changed.connect(self.matching.show_certain)
        pane.form.asked.connect(self.matching.start)
        pane.form.cancelled.connect(self.matching.cancel)
        pane.many.match_asked.connect(self.match_all)
        pane.many.photo_chosen.connect(self.photos.open)
        pane.result.apply_asked.connect(self.matching.apply)
        pane.result.cure_asked.connect(self._cure)
        self.matching.matched.connect(self.comparison.show_match)
        self.matching.matched.connect(self._on_match)
        self.photos.reading_changed.connect(self._show_reading)
        # Not by lambdas: a signal would hold them, and they this object, beyond the window's end.
        self.photos.begun.connect(self._show_begun)
        self.photos.ended.connect(self._show_ended)
        self.photos.opened.connect(self._take_listed)
        self.many.matched.connect(self._take_listed_now)
        scenes.changed.connect(pane.show_scene)
        pane.show_scene(scenes.scene)
        self._show_reading(self.photos.reading)

    def _take_listed(self, photo: Photo | None) -> None:
        """Show what the table of several photos has found in this one, if it was read alike."""
        self._pane.many.rows.show_open(None if photo is None else photo.path)
        row = None if photo is None else self._pane.many.rows.row_of(photo.path)
        alike = self.many.reading in (None, self.photos.reading)
        found = None if row is None else row.match
        if found is not None and alike and self.lamps.region is None:
            self._pane.keep_in_view(partial(self.matching.take_over, found))

    def _take_listed_now(self) -> None:
        """Show what the table has just found in the open photo, unless it is matched by itself."""
        if self.matching.match is None:
            self._take_listed(self.matching.photo)

    def _connect_lamps(self) -> None:
        form, lamps = self._pane.lamps, self.lamps
        form.find_asked.connect(lamps.find)
        form.chosen.connect(lamps.choose)
        form.by_hand_chosen.connect(lamps.set_by_hand)
        form.whole_asked.connect(lamps.match_whole)
        self.outlines.clicked.connect(lamps.choose)
        self.outlines.drawn.connect(lamps.draw)
        lamps.searching.connect(form.show_searching)
        lamps.failed.connect(form.show_sentence)
        lamps.region_changed.connect(self.matching.set_region)
        lamps.region_changed.connect(self.comparison.set_region)
        lamps.region_changed.connect(self.chips.set_region)
        lamps.region_changed.connect(self._show_region)
        self._image.photo.graphics.scene().sigMouseClicked.connect(self._click)

    def _cure(self) -> None:
        """Show the simulation at a shutter speed without bars, beside the photo."""
        self.matching.cure()
        self._image.set_mode(MODES[0])

    def _show_begun(self) -> None:
        self.matching.show_reading(True)

    def _show_ended(self) -> None:
        self.matching.show_reading(False)

    def _click(self, event: MouseClickEvent) -> None:
        self.outlines.click(self._image.photo.box.mapSceneToView(event.scenePos()))

    def _show_region(self, region: Lamp | Region | None) -> None:
        by_hand = self.lamps.by_hand
        within = region.region if isinstance(region, Lamp) else region
        self._pane.lamps.show_region(within, self.lamps.chosen)
        self._pane.lamps.show_by_hand(by_hand is not None)
        self.outlines.show_rectangle(by_hand)
        if region is not None and self._image.mode.key() != MODES[0]:
            # Lamps and regions are drawn on the photo beside the picture.
            self._image.mode_chosen.emit(MODES[0])

    @property
    def is_idle(self) -> bool:
        """Whether no work is running in the background."""
        parts = (
            self.photos, self.matching, self.many, self.lamps, self.comparison, self.chips
        )  # fmt: skip
        return all(part.runner.is_idle for part in parts)

    def kept(self) -> KeptPhoto | None:
        """Return the open photo with all that is known of it; None if none is open."""
        if self.photos.photo is None:
            return None
        return KeptPhoto(
            self.photos.photo,
            self.photos.reading,
            self.lamps.kept(),
            self.matching.kept(),
            self._pane.result.given,
            self._pane.form.choice(),
            self._pane.form.certain_values,
            self.placements.placement if self.placements.is_by_hand else None,
        )

    def give_back(self, kept: KeptPhoto) -> None:
        """Show a photo again with all that was known of it, after another one was open."""
        self.photos.show_again(kept.photo, kept.reading)
        self._pane.form.show_choice(kept.choice, kept.certain)
        self.lamps.give_back(kept.region)
        if kept.match is not None:
            self.matching.give_back(kept.match)
            self._pane.result.show_given(kept.given)
        if kept.placement is not None:
            self.placements.move(kept.placement)

    def begin_form(self, frequency: float) -> None:
        """Begin with the form as at first, the photo's switching frequency in Hz being certain."""
        self._pane.form.show_choice(MatchChoice(), {"switching_frequency": frequency})

    def match(self) -> None:
        """Match the photo with the choices of the pane."""
        self.matching.start(self._pane.form.choice())

    def match_all(self) -> None:
        """Match the photos of the table with the choices of the pane."""
        self.many.start(self._pane.form.choice(), self.photos.reading)

    def _let_move(self, by_mouse: bool) -> None:
        self._image.overlay.set_movable(by_mouse)
        if by_mouse and self._image.mode.key() == MODES[0]:
            # A photo beside the picture cannot be moved over it.
            self._image.mode_chosen.emit(MODES[1])

    def _on_match(self, match: Match) -> None:
        # A placement by hand belongs to the picture before the match.
        self.placements.reset()
        photo, rows = self.matching.photo, self._pane.many.rows
        row = None if photo is None else rows.row_of(photo.path)
        rows.show_earlier(None if row is None or row.match is match else row.path)

    def _show_placement(self, placement: Placement) -> None:
        self._image.show_placement(placement)
        self._pane.show_placement(placement, self.placements.is_by_hand)

    def _show_reading(self, reading: PhotoReading) -> None:
        self._pane.facts.show_reading(reading.channel, reading.scan_axis)

    def stop(self) -> None:
        """Stop the work in the background."""
        self.many.stop()
        self.matching.stop()
        self.chips.stop()
        self.comparison.stop()
        self.lamps.stop()
        self.photos.stop()
