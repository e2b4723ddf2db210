"""Controllers of the photo, connected with the panes: reading, placing, comparing, matching."""

from dataclasses import replace
from functools import partial

from pyqtgraph.GraphicsScene.mouseEvents import MouseClickEvent

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
from occ_gui.picture.placement import MODES, Placement, PlacementStore
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import Board
from occ_gui.simulation.snapshot import Reading
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Match


class PhotoWiring(Pane[Reading | None]):
    """Connects the controllers of a photo with the panes that show it.

    Parameters
    ----------
    scenes
        The scene that a photo is matched with.
    photos
        Reads the photo.
    image
        The pane of the picture, which the photo lies beside or on.
    board
        Takes what is read of the photo.
    """

    def __init__(
        self, scenes: SceneStore, photos: PhotoController, image: ImageView, board: Board
    ) -> None:
        self.view = pane = PhotoView()
        super().__init__(pane)
        self._image, self._store, self.photos = image, scenes.store, photos
        self.verdict = pane.verdict
        self.placements = PlacementStore()
        self.comparison = ComparisonController(self.placements, board)
        self.matching = MatchController(scenes, pane)
        self.many = ManyPhotosController(scenes, pane.many)
        self.chips = ChipController(board)
        self.outlines = LampOutlines(image.photo.box)
        self.lamps = LampController((pane.lamps, self.outlines))
        photos.show_on([image, pane, self.comparison, self.matching, self.chips, self.lamps])
        self._connect_lamps()
        self.placements.changed.connect(self._show_placement)
        image.overlay.placed.connect(self.placements.move)
        pane.placement.placed.connect(self.placements.move)
        pane.placement.reset_asked.connect(self.placements.reset)
        pane.placement.moving_chosen.connect(self._let_move)
        enhanced = self._store.select(lambda workspace: workspace.is_enhanced)
        enhanced.changed.connect(self.comparison.set_enhanced)
        self.comparison.set_enhanced(enhanced.value)
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
        self.view.many.rows.show_open(None if photo is None else photo.path)
        row = None if photo is None else self.view.many.rows.row_of(photo.path)
        alike = self.many.reading in (None, self.photos.reading)
        found = None if row is None else row.match
        if found is not None and alike and self.lamps.region is None:
            self.view.keep_in_view(partial(self.matching.take_over, found))

    def _take_listed_now(self) -> None:
        """Show what the table has just found in the open photo, unless it is matched by itself."""
        if self.matching.match is None:
            self._take_listed(self.matching.photo)

    def _connect_lamps(self) -> None:
        form, lamps = self.view.lamps, self.lamps
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
        self.view.lamps.show_region(within, self.lamps.chosen)
        self.view.lamps.show_by_hand(by_hand is not None)
        self.outlines.show_rectangle(by_hand)
        if region is not None and self._image.mode.key() != MODES[0]:
            # Lamps and regions are drawn on the photo beside the picture.
            self._lay(MODES[0])

    def _lay(self, mode: str) -> None:
        """Lay the photo beside the picture or over it."""
        self._store.put(replace(self._store.workspace, overlay=mode))

    def show_part(self, part: Reading | None) -> None:
        """Compare the photo with this reading of the scene."""
        if part is not None:
            self.comparison.show_reading(part)

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
            self.view.result.given,
            self.view.form.choice(),
            self.view.form.certain_values,
            self.placements.placement if self.placements.is_by_hand else None,
        )

    def give_back(self, kept: KeptPhoto) -> None:
        """Show a photo again with all that was known of it, after another one was open."""
        self.photos.show_again(kept.photo, kept.reading)
        self.view.form.show_choice(kept.choice, kept.certain)
        self.lamps.give_back(kept.region)
        if kept.match is not None:
            self.matching.give_back(kept.match)
            self.view.result.show_given(kept.given)
        if kept.placement is not None:
            self.placements.move(kept.placement)

    def begin_form(self, frequency: float) -> None:
        """Begin with the form as at first, the photo's switching frequency in Hz being certain."""
        self.view.form.show_choice(MatchChoice(), {"switching_frequency": frequency})

    def match(self) -> None:
        """Match the photo with the choices of the pane."""
        self.matching.start(self.view.form.choice())

    def match_all(self) -> None:
        """Match the photos of the table with the choices of the pane."""
        self.many.start(self.view.form.choice(), self.photos.reading)

    def _let_move(self, by_mouse: bool) -> None:
        self._image.overlay.set_movable(by_mouse)
        if by_mouse and self._image.mode.key() == MODES[0]:
            # A photo beside the picture cannot be moved over it.
            self._lay(MODES[1])

    def _on_match(self, match: Match) -> None:
        # A placement by hand belongs to the picture before the match.
        self.placements.reset()
        photo, rows = self.matching.photo, self.view.many.rows
        row = None if photo is None else rows.row_of(photo.path)
        rows.show_earlier(None if row is None or row.match is match else row.path)

    def _show_placement(self, placement: Placement) -> None:
        self._image.show_placement(placement)
        self.view.show_placement(placement, self.placements.is_by_hand)

    def _show_reading(self, reading: PhotoReading) -> None:
        self.view.facts.show_reading(reading.channel, reading.scan_axis)

    def stop(self) -> None:
        """Stop the work in the background."""
        self.many.stop()
        self.matching.stop()
        self.chips.stop()
        self.comparison.stop()
        self.lamps.stop()
        self.photos.stop()
