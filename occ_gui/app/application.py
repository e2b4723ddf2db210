"""Application: creates stores, controllers, panes and window, and connects them."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, QSettings, Qt

from occ_gui.accuracy.cost_sentences import switch_sentence
from occ_gui.accuracy.plan_changes import PlanNews
from occ_gui.app.about import show_about
from occ_gui.app.desktop import Desktop
from occ_gui.app.features import features
from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.app.status_messages import StatusMessages
from occ_gui.app.story_wiring import connect_story
from occ_gui.app.video_pane import VideoPane
from occ_gui.app.welcome import Welcome
from occ_gui.core.store import NO_GESTURE, Store
from occ_gui.core.workspace import FIRST_SETTINGS, Workspace
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.detection_map.wiring import Measuring
from occ_gui.files.file_controller import FileController, sample_photos
from occ_gui.files.preferences import Preferences
from occ_gui.files.preset_controller import PresetController
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.picture.before_controller import BeforeController
from occ_gui.picture.feature import picture
from occ_gui.pins.pin_controller import PinController
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.forced_effects import forced_text
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.mark_controller import MarkController
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.outdated_marks import OutdatedMarks
from occ_gui.shell.results import Board
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.present_results import PresentResults
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.story.story_view import StoryView
from occ_gui.values.photo_choice import PhotoChoice
from occ_gui.values.photo_results import OpenPhoto
from occ_gui.window.main_window import MainWindow
from occ_gui.window.menus import words_of
from occ_model.effects.registry import EFFECTS
from occ_model.photo.reading.load import Photo
from occ_model.plugins import all_at_work
from occ_model.receiver.decoders import DECODERS, decoders
from occ_model.results.match import Match
from occ_model.results.plan import Decision
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.study.cause import Step

if TYPE_CHECKING:
    from occ_gui.photo.pane import PhotoPane
    from occ_gui.photo.photo_view import PhotoView


class Application(QObject):
    """Store, controllers, views and window, connected.

    Parameters
    ----------
    scene
        The first scene.
    settings
        The first settings of its simulation.
    preferences
        The stored preferences; by default nothing is stored.
    """

    def __init__(
        self,
        scene: Scene,
        settings: SimulationSettings = FIRST_SETTINGS,
        preferences: QSettings | None = None,
    ) -> None:
        super().__init__()
        workspace = Store(Workspace(scene, settings))
        self.store = SceneStore(workspace, {e.name: e.label for e in EFFECTS})
        self.settings = self.store.settings
        self.editor = SceneEditor(self.store)
        self.preferences = Preferences(preferences)
        # Simulates the first picture while the panes are created.
        self.simulation = SimulationController(self.store, self.settings)
        effects = dict.fromkeys(name for effect in EFFECTS for name in effect.parameters)
        stages = {name: e.stage for e in reversed(EFFECTS) for name in e.parameters}
        self.controls = ControlPanel([], [*effects], {name: stages[name] for name in effects})
        self.board = Board()
        self.shell = Shell(workspace, self.board)
        self.story = StoryView(self.shell.embed(picture(workspace, self.about_photo)), [*DECODERS])
        self.marks = MarkController(self.store, self.controls)
        self.slider_strips = SliderStrips(self.controls.main_rows())
        self.window = MainWindow(self.controls, self.story, undo_stack=self.store.undo_stack)
        self.messages = StatusMessages(self.window, self.controls)
        self.photos = PhotoController(workspace, self.board)
        self.presets = PresetController(self.window, self.store)
        self.present = PresentResults(self.simulation)
        self.files = FileController(
            self.window, self.store, self.photos, self.preferences, self.present.ask
        )
        self.simulation.picture_ready.connect(self.board.show_picture)
        self.frame_rate = FrameRate(workspace)
        self.measuring = Measuring(self.store, self.slider_strips)
        self.simulation.defer_while(self._is_map_awaited)
        self._declare_panes(workspace)
        self._show_results()
        self.outdated = OutdatedMarks(self.board, self.simulation, self.window)
        connect_story(self)
        self.shell.made.connect(self._on_made)
        # Before the session is written.
        self.window.closing.connect(self._begin_to_end)
        self.desktop = Desktop(self)
        self.welcome = Welcome(self.window, self.shell, self.preferences, self.files)
        self._match_next, self._front_next = False, True
        self._photo_path: Path | None = None
        self._connect_scene()
        self._connect_settings()
        self._connect_photo()
        self._connect_menus()
        self._connect_slider_strips()
        self._show_first(scene, settings)

    def _declare_panes(self, workspace: Store) -> None:
        self.before = BeforeController(workspace, [self.board])
        self.pins = PinController(self.store, self.present.is_present)
        self.lessons = LessonsInWindow(self.window, self.shell)
        self.video = VideoPane(
            self.window,
            self.shell,
            workspace,
            self.files.ask_for_film,
            self.files.ask_to_save_film,
        )
        for feature in features(self):
            self.shell.add(feature, self.window)

    def _show_results(self) -> None:
        self.news = PlanNews(self.window)
        self.news.changed.connect(self.board.show_switched)
        self.news.changed.connect(self._tell_switched)
        # What the pictures are compared with comes before them.
        views = (self.before, self.pins, self.news, self.board)
        self.simulation.show_in(views, (self.story, self.board))

    def _tell_switched(self, switched: tuple[Decision, ...]) -> None:
        self.window.show_plan_change(switch_sentence(switched) if switched else "")

    def _show_first(self, scene: Scene, settings: SimulationSettings) -> None:
        self._list_presets()
        self._list_recent()
        self.window.menus.show_samples(sample_photos(), self.files.open_sample)
        self._show_scene(scene)
        self._show_settings(settings)

    def _connect_scene(self) -> None:
        self.controls.connect_editor(self.editor)
        self.controls.player.run_changed.connect(self.outdated.follow_run)
        self.editor.edit_started.connect(self.messages.end_refusal)
        self.editor.input_refused.connect(self.messages.show_refusal)
        self.controls.preset_chosen.connect(self.presets.load)
        self.presets.changed.connect(self._list_presets)
        self.lessons.begun.connect(self.presets.keep_base)
        self.window.actions_by_name["lessons"].triggered.connect(self._show_lessons)
        self.pins.both_pinned.connect(self._show_comparison)
        self.store.changed.connect(self._show_scene)
        self.store.refused.connect(self._refuse)
        self.store.refused_for.connect(self.messages.show_refusal_for)
        self.simulation.snapshot_shown.connect(self._on_snapshot)
        # Looking for plug-ins takes some 40 ms: not before the first picture.
        once = Qt.ConnectionType.SingleShotConnection
        self.simulation.snapshot_shown.connect(self._offer_plugins, once)
        verdict = self.story.verdict
        self.window.leave_messages_to(verdict.sentence, verdict.wrapped)
        self.simulation.failed_for.connect(self.messages.show_failure)
        self.simulation.failed.connect(self.pins.give_up)
        for speaker in (self.presets, self.files, self.present, self.video):
            speaker.status_message.connect(self.window.say)
        for noted in (self.lessons, self.pins):
            noted.status_message.connect(self.messages.show_note)
        self.window.closing.connect(self.stop)

    def _connect_settings(self) -> None:
        self.controls.forced.released.connect(self.store.release_effects)
        self.settings.changed.connect(self._show_settings)
        self.settings.refused.connect(self.messages.show_refusal)

    def _connect_photo(self) -> None:
        reading = self.photos.work
        self.photos.failed.connect(self._on_photo_failure)
        self.photos.opened.connect(self._on_photo)
        reading.begun.connect(self._begin_photo)
        reading.task.reported.connect(self.window.reading.show_progress)
        reading.ended.connect(self.window.reading.end)
        reading.found.connect(self._on_photo_read)
        self.window.reading.cancelled.connect(self._cancel_photo)
        self.preferences.changed.connect(self._list_recent)
        self.window.dropped.connect(self.files.open_dropped)
        self.files.film_asked.connect(self.video.open)
        self.files.film_save_asked.connect(self.video.save)
        self.files.several_opened.connect(self._show_several)

    def _connect_menus(self) -> None:
        for name, slot in {
            "open_photo": self.files.ask_for_photo,
            "close_photo": self.photos.close,
            "open_scene": self.files.ask_for_scene,
            "save_picture": self.files.ask_to_save_picture,
            "delete_preset": self.presets.ask_to_delete,
            "match": self._match,
            "fit": self._fit,
            "about": lambda: show_about(self.window),
        }.items():
            self.window.actions_by_name[name].triggered.connect(slot)
        menus = self.window.menus
        self.window.actions_by_name["match_all"].setEnabled(False)
        menus.scan_axes.triggered.connect(lambda action: self.photos.scan_along(action.data()))
        axis = self.store.store.select(lambda workspace: workspace.photo.reading.scan_axis)
        axis.changed.connect(self._show_scan_axis)
        menus.overlays.triggered.connect(lambda action: self.show_mode(action.data()))
        overlay = self.store.store.select(lambda workspace: workspace.overlay)
        overlay.changed.connect(self._show_overlay)

    def _connect_slider_strips(self) -> None:
        self.controls.add_foot(self.slider_strips.legend)
        shown = self.window.actions_by_name["slider_strips"]
        shown.toggled.connect(self.slider_strips.set_shown)
        shown.triggered.connect(self.preferences.keep_slider_strips)
        self.slider_strips.set_shown(self.preferences.slider_strips)
        shown.setChecked(self.preferences.slider_strips)
        decoder = self.store.store.select(lambda workspace: workspace.decoder)
        decoder.changed.connect(self.measuring.slider_strips.choose_decoder)
        decoder.changed.connect(self.simulation.read_with)
        decoder.changed.connect(self.measuring.own_rate.choose_decoder)
        self.measuring.own_rate.changed.connect(self.story.verdict.show_rate)
        self.story.verdict.step_chosen.connect(self._take_step)
        self.story.verdict.lesson_wanted.connect(self._show_lesson)

    @property
    def is_idle(self) -> bool:
        """Whether all requested results are shown."""
        parts = (
            self.simulation, self.outdated, self.desktop, self.pins, self.shell,
        )  # fmt: skip
        return all(part.is_idle for part in parts)

    def open_photo(self, path: Path, match: bool = False, front: bool = True) -> None:
        """Open a photo.

        Parameters
        ----------
        path
            The file.
        match
            Whether to match it and to apply the result to the scene.
        front
            Whether to bring its pane to the front.
        """
        self._match_next, self._front_next = match, front
        self.photos.open(path)

    def resume_photo(self, choice: PhotoChoice) -> None:
        """Open the photo of the last session with what was set about it, and leave it behind."""
        self._front_next = choice.path is None
        self.photos.edit(lambda _first: choice)

    def _is_map_awaited(self) -> bool:
        pane = self.shell.made_pane("map")
        return pane is not None and pane.map.is_first_answer_awaited

    @property
    def is_measured(self) -> bool:
        """Whether the processes have measured all that is seen."""
        return self.measuring.is_idle and self.shell.is_measured

    def view(self, name: str) -> Any:
        """Give the view of a pane, which is made if it has never been seen."""
        return self.shell.pane(name).view

    def about_photo(self) -> str:
        """Return the photo's name and what its match is worth; empty if none is open."""
        pane: PhotoPane | None = self.shell.made_pane("photo")
        return "" if pane is None else pane.verdict.about()

    @property
    def _photo(self) -> "PhotoPane":
        pane: PhotoPane = self.shell.pane("photo")
        return pane

    def choose_decoder(self, name: str) -> None:
        """Show what this decoder reads, everywhere."""
        store = self.store.store
        store.put(replace(store.workspace, decoder=name))

    def _on_made(self, name: str, pane: Any) -> None:
        self.outdated.mark_pane(pane)
        if name == "accuracy":
            self.messages.follow(pane.view)
        elif name == "decode":
            self.outdated.mark_verdict(pane.view)
        elif name == "profile":
            pane.view.chips.copied.connect(self.window.say)
        elif name == "photo":
            self._connect_photo_pane(pane, pane.view)

    def _connect_photo_pane(self, pane: "PhotoPane", view: "PhotoView") -> None:
        verdict = view.verdict
        self.messages.follow(view)
        self.window.leave_messages_to(verdict.sentence, verdict.wrapped)
        view.open_asked.connect(self.files.ask_for_photo)
        view.show_samples({words_of(path.stem): path for path in sample_photos()})
        view.sample_chosen.connect(self.files.open_sample)
        view.form.edited.connect(self.editor.edit)
        view.result.save_asked.connect(self._save_match)
        view.many.save_asked.connect(self.files.ask_to_save_table)
        view.many.files_shown.connect(self._show_listed)
        for copying in (view.many, view.result.paste):
            copying.copied.connect(self.window.say)
        # They are enabled once there is a photo.
        for name, slot in {
            "match_all": pane.match_all,
            "find_lamps": pane.parts.find,
            "region_by_hand": view.lamps.by_hand.toggle,
            "whole_photo": pane.parts.match_whole,
            "apply_match": pane.matching.apply,
            "save_match": self._save_match,
            "use_settings": pane.matching.use_notes,
        }.items():
            self.window.actions_by_name[name].triggered.connect(slot)
        pane.matching.saved.connect(self.presets.report_saved)
        pane.match_shown.connect(self._on_match)
        pane.matching.failed.connect(self.messages.show_match_failure)

    def _save_match(self) -> None:
        self.presets.ask_to_save_match(self._photo.matching)

    def _fit(self) -> None:
        if (pane := self.shell.made_pane("picture")) is not None:
            pane.view.fit()

    def _begin_photo(self) -> None:
        self.shell.pane("photo")  # before there is something to show
        self.window.reading.begin()

    def _show_lessons(self) -> None:
        self.window.bring_to_front("lessons")

    def _show_lesson(self, name: str) -> None:
        self._show_lessons()
        self.shell.pane("lessons").controller.set_seen(True)
        self.shell.pane("lessons").controller.choose(name)

    def _show_comparison(self) -> None:
        self.window.bring_to_front("compare")

    def _show_several(self, paths: list[Path]) -> None:
        self._photo.many.choose_files(paths)
        self.window.bring_to_front("photo")

    def _show_listed(self) -> None:
        paths = self._photo.view.many.rows.paths
        self.window.actions_by_name["match_all"].setEnabled(bool(paths))

    def show_mode(self, mode: str) -> None:
        """Show the photo beside the simulated picture or over it, by one of MODES."""
        store = self.store.store
        store.put(replace(store.workspace, overlay=mode))

    def _show_overlay(self, mode: str) -> None:
        self.window.menus.show_choice(self.window.menus.overlays, mode)

    def _show_scan_axis(self, scan_axis: str) -> None:
        self.window.menus.show_choice(self.window.menus.scan_axes, scan_axis)

    def _match(self) -> None:
        self.window.bring_to_front("photo")
        self._photo.match()

    def _show_scene(self, scene: Scene) -> None:
        self.messages.end_refusal()
        self.controls.show_scene(scene)
        self.controls.show_preset(*self.presets.follow(scene))

    def _list_presets(self) -> None:
        presets = self.presets
        self.controls.list_presets(presets.titles, presets.unreadable, presets.own)
        self.controls.show_preset(*self.presets.follow(self.store.scene))

    def _list_recent(self) -> None:
        preferences, menus = self.preferences, self.window.menus
        menus.show_recent(preferences.files, self.files.open_recent, preferences.clear)

    def _show_settings(self, settings: SimulationSettings) -> None:
        self.messages.end_refusal()
        self.controls.forced.show_list(forced_text(settings.force, self.settings.effect_labels))

    def _refuse(self, sentence: str) -> None:
        # The control still shows the refused value.
        self.controls.show_scene(self.store.scene)
        self.messages.show_refusal(sentence)

    def _cancel_photo(self) -> None:
        self._match_next = False
        self.photos.cancel()

    def _on_photo_failure(self, sentence: str) -> None:
        self._match_next = False
        self.messages.show_photo_failure(sentence)

    def _offer_plugins(self) -> None:
        if decoders() != tuple(DECODERS):
            self.story.offer(decoders())

    def _on_snapshot(self, snapshot: Snapshot) -> None:
        self.messages.end_failure()
        self.window.show_timing(snapshot.simulation_seconds, snapshot.reading_seconds)

    def _take_step(self, step: Step) -> None:
        if step.decoder:
            self.choose_decoder(step.decoder)
        else:
            self.store.change(NO_GESTURE, **step.changes)

    def _on_photo_read(self, opened: OpenPhoto) -> None:
        """Bring a photo to the front that was read for the first time, and not in another way."""
        last, self._photo_path = self._photo_path, opened.source.path
        if self._front_next and last != self._photo_path:
            self.window.bring_to_front("photo")
        self._front_next = True

    def _on_photo(self, photo: Photo | None) -> None:
        self.messages.end_photo_failure()
        self.window.show_photo_name(None if photo is None else photo.path.name)
        if photo is None:
            self._photo_path = None
        if self._match_next:
            self._photo.match()

    def _on_match(self, match: Match | None) -> None:
        self.window.menus.show_match_found(match is not None)
        if match is None:
            return
        self.messages.end_match_failure()
        if self._match_next:
            self._match_next = False
            self._photo.matching.apply()

    def _begin_to_end(self) -> None:
        # What follows waits for work, and somebody may lose patience first.
        self.desktop.autosave.write()
        for who in all_at_work():
            self.window.say(f"{who} is waited for.")
            self.window.repaint()
        self.simulation.stop()  # of the scene that is restored no picture is needed
        self.lessons.end()

    def stop(self) -> None:
        """Stop all work in the background."""
        self.simulation.stop()
        self.pins.stop()
        self.shell.stop()
        self.measuring.stop()
        self.desktop.stop()
