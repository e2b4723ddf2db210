"""The pane of the photo: shows settings and results, turns input into edits, and finds lamps."""

from dataclasses import replace

from pyqtgraph.GraphicsScene.mouseEvents import MouseClickEvent
from PySide6.QtCore import QObject

from occ_gui.background.task import Task
from occ_gui.photo.fitted_stripes import FittedStripes
from occ_gui.photo.lamp_views import LampOutlines
from occ_gui.photo.many.many_controller import ManyPhotosController
from occ_gui.photo.match_controller import MatchController
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.photo.photo_view import PhotoView
from occ_gui.photo.photo_work import (
    comparison_inputs,
    cure_of_match,
    find_lamps,
    make_chip_updater,
    make_stripe_updater,
    photo_profile,
)
from occ_gui.photo.shown_photo import PartEdits, ShownPhoto
from occ_gui.photo.window_actions import WindowActions
from occ_gui.picture.image_view import ImageView
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import ResultsStore, make_remark, next_match
from occ_gui.values.choices import MatchChoice, PlacedPhoto, Placement
from occ_model.photo.reading.load import Photo
from occ_model.results.lamp import Lamp


class LampSearch(QObject):
    def __init__(self, photos: PhotoController, results_store: ResultsStore) -> None:
        super().__init__()
        self._photos = photos
        self.task: Task[Photo, tuple[Lamp, ...]] = Task(
            find_lamps, "search for lamps", impatient=True
        )
        self.task.finished.connect(lambda lamps: self._put(is_searched=False, lamps=lamps))
        self.task.failed.connect(lambda why: self._put(is_searched=False, why_no_lamps=why))
        results_store.select(lambda results: results.photo).changed.connect(self.task.cancel)

    def find(self) -> None:
        document = self._photos.document
        if document is not None:
            self._put(is_searched=True, lamps=(), why_no_lamps="")
            self.task.ask(document.photo)

    def _put(self, **changes: object) -> None:
        document = self._photos.document
        if document is not None:
            self._photos.put(replace(document, **changes))  # type: ignore[arg-type]  # its fields


class PhotoPane(Pane[ShownPhoto]):
    def __init__(
        self,
        scenes: SceneStore,
        photos: PhotoController,
        image: ImageView,
        results_store: ResultsStore,
        window: WindowActions,
    ) -> None:
        self.view = view = PhotoView()
        super().__init__(view)
        self._image, self._store, self._results_store, self.photos = (
            image,
            scenes.store,
            results_store,
            photos,
        )
        self.matching = MatchController(scenes, photos, results_store)
        self.parts = PartEdits(scenes.store, results_store)
        self.many = ManyPhotosController(scenes, photos, view.many, results_store)
        self.lamps = LampSearch(photos, results_store)
        self._updaters = (
            make_stripe_updater(scenes.store, results_store),
            make_chip_updater(scenes.store, results_store),
        )
        parts = (photos.loading, self.matching, self.lamps, self.many, *self._updaters)
        self.tasks = tuple(part.task for part in parts)
        self.outlines = LampOutlines(image.photo.box)
        self.stripes = FittedStripes(image.photo.box)
        self._shown = ShownPhoto(scenes.scene, photos.choice)
        self._comparison_inputs = comparison_inputs(self._shown)
        view.show_photo(self._shown)
        self.matching.task.reported.connect(view.form.show_progress)
        self._connect_view()
        self._connect_window(window)

    def _connect_window(self, window: WindowActions) -> None:
        view = self.view
        self.sentences = (view.verdict.sentence, view.verdict.wrapped)
        self.matching.failed.connect(self._remark_on_match)
        for sentence in (view.many.copied, view.result.paste.copied):
            sentence.connect(self.status_message)
        for form in (view.form, view.placement):
            form.refused.connect(self.status_message)
            form.accepted.connect(self.accepted)
        view.open_asked.connect(window.ask_for_photo)
        view.show_samples(window.samples())
        view.sample_chosen.connect(window.open_sample)
        view.form.edited.connect(window.edit_scene)
        view.result.save_asked.connect(lambda: window.save_match(self.matching))
        view.many.save_asked.connect(window.save_table)

    def _remark_on_match(self, sentence: str) -> None:
        results = self._results_store.results
        last = make_remark(sentence, next_match, self._store.workspace, results)
        self._results_store.put(replace(results, remark=last))

    def _connect_view(self) -> None:
        view, image, photos, matching = self.view, self._image, self.photos, self.matching
        for source in (image.overlay, view.placement):
            source.placed.connect(self._place)
        view.placement.reset_asked.connect(self._reset_placement)
        view.placement.moving_chosen.connect(self._set_movable)
        view.facts.channel.chosen.connect(photos.set_channel)
        view.facts.scan_axis.chosen.connect(photos.set_scan_axis)
        view.facts.settings_asked.connect(matching.apply_camera_settings)
        view.form.chosen.connect(self._take_form)
        view.form.certain_chosen.connect(self._take_certain)
        view.form.asked.connect(matching.start)
        view.form.cancelled.connect(matching.cancel)
        view.many.match_asked.connect(self.match_all)
        view.many.photo_chosen.connect(photos.open)
        view.result.apply_asked.connect(matching.apply)
        view.result.cure_asked.connect(self._apply_cure)
        form, parts = view.lamps, self.parts
        form.find_asked.connect(self.lamps.find)
        form.by_hand_chosen.connect(parts.set_by_hand)
        form.whole_asked.connect(parts.match_whole)
        for signal in (form.chosen, self.outlines.clicked):
            signal.connect(parts.choose)
        self.outlines.drawn.connect(parts.draw)
        image.photo.graphics.scene().sigMouseClicked.connect(self._click)

    def show_part(self, part: ShownPhoto) -> None:
        last = self._shown
        cure = last.cure if part.match is last.match else cure_of_match(part.match)
        shown = self._shown = replace(part, cure=cure)
        if shown.photo is not last.photo:
            self._image.show_photo(shown.photo)
        if shown.placement != last.placement:
            self._image.show_placement(shown.placement)
        self.view.show_photo(shown)
        self.outlines.show_photo(shown)
        if shown.present_match is not last.present_match:
            self.stripes.show_match(shown.present_match)
        self._act_on_change(shown, last)

    def _act_on_change(self, shown: ShownPhoto, last: ShownPhoto) -> None:
        """Act on a change, which may change the photo again; that change is then shown."""
        if shown.choice.listed != last.choice.listed:
            self.many.forget_rows()
        if shown.part != last.part:
            self.matching.cancel()
            if shown.part is not None:
                # Lamps and regions are drawn on the photo beside the picture.
                self._set_overlay("beside")
        inputs = comparison_inputs(self._shown)
        if inputs != self._comparison_inputs:
            self._comparison_inputs = inputs
            profile = photo_profile(self._shown)
            self._results_store.put(replace(self._results_store.results, photo_profile=profile))

    # Handling the user's input.

    def match(self) -> None:
        self.matching.start(self.view.form.choice())

    def match_all(self) -> None:
        self.many.start(self.view.form.choice())

    def _take_form(self, form: MatchChoice) -> None:
        self.photos.edit(lambda choice: replace(choice, form=form))

    def _take_certain(self, name: str, value: float | None) -> None:
        self.photos.edit(lambda choice: choice.with_certain(name, value))

    def _place(self, placement: Placement | None) -> None:
        document = self._results_store.results.document
        if document is not None:
            placed = None if placement is None else PlacedPhoto(document.source, placement)
            self.photos.edit(lambda choice: replace(choice, placed_photo=placed))

    def _reset_placement(self) -> None:
        self._place(None)

    def _apply_cure(self) -> None:
        """Show the simulation at a shutter speed without bars next to the photo."""
        self.matching.cure()
        self._set_overlay("beside")

    def _set_overlay(self, mode: str) -> None:
        self._store.put(replace(self._store.workspace, overlay=mode))

    def _set_movable(self, by_mouse: bool) -> None:
        self._image.overlay.set_movable(by_mouse)
        if by_mouse and self._store.workspace.overlay == "beside":
            # A photo beside the picture cannot be moved over it.
            self._set_overlay("blend")

    def _click(self, event: MouseClickEvent) -> None:
        self.outlines.click(self._image.photo.box.mapSceneToView(event.scenePos()))
