"""Application: creates stores, controllers, panes and window, and connects them."""

from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, QSettings, Qt

from occ_gui.accuracy.accuracy_view import AccuracyView
from occ_gui.accuracy.controller import AccuracyController
from occ_gui.app.about import show_about
from occ_gui.app.desktop import Desktop
from occ_gui.app.features import features
from occ_gui.app.lessons_in_window import LessonsInWindow
from occ_gui.app.outdated_panes import OutdatedPanes
from occ_gui.app.status_messages import StatusMessages
from occ_gui.app.story_wiring import tell_story
from occ_gui.app.video_pane import VideoPane
from occ_gui.app.welcome import Welcome
from occ_gui.core.store import NO_GESTURE, Store
from occ_gui.core.workspace import FIRST_SETTINGS, Workspace
from occ_gui.decoding.decode_view import DecodeView
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.detection_map.wiring import Measuring
from occ_gui.files.file_controller import FileController, sample_photos
from occ_gui.files.preferences import Preferences
from occ_gui.files.preset_controller import PresetController
from occ_gui.photo.photo_controller import PhotoReading
from occ_gui.photo.photo_view import PhotoView
from occ_gui.photo.wiring import PhotoWiring
from occ_gui.picture.before_controller import BeforeController
from occ_gui.picture.image_view import ImageView
from occ_gui.pins.pin_controller import PinController
from occ_gui.profile.profile_view import ProfileView
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.forced_effects import forced_text
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.mark_controller import MarkController
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import Board
from occ_gui.shell.shell import Shell
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.present_results import PresentResults
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.story.story_view import StoryView
from occ_gui.window.main_window import MainWindow
from occ_model.effects.registry import EFFECTS
from occ_model.photo.reading.load import Photo
from occ_model.plugins import all_at_work
from occ_model.receiver.decoders import DECODERS, decoders
from occ_model.results import Match
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.study.cause import Step


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
        self.image, self.profile, self.decode = ImageView(), ProfileView(), DecodeView([*DECODERS])
        self.accuracy, self.photo = AccuracyView(), PhotoView()
        self.story = StoryView(self.image, [*DECODERS])
        self.marks = MarkController(self.store, self.controls)
        self.slider_strips = SliderStrips(self.controls.main_rows())
        self.window = MainWindow(
            self.controls, self.story, self.profile, self.decode, self.photo, self.accuracy,
            undo_stack=self.store.undo_stack,
        )  # fmt: skip
        self.messages = StatusMessages(self.window, self.controls)
        self.photo_wiring = PhotoWiring(self.store, self.image, self.profile, self.photo)
        self.photos = self.photo_wiring.photos
        self.presets = PresetController(self.window, self.store, self.photo_wiring.matching)
        self.present = PresentResults(self.simulation)
        self.files = FileController(
            self.window, self.store, self.photos, self.preferences, self.present.ask
        )
        self.simulation.picture_ready.connect(self.image.show_picture)
        self.study = AccuracyController(self.store, self.settings, self.simulation, self.accuracy)
        self.frame_rate = FrameRate(workspace)
        self.measuring = Measuring(self.store, self.slider_strips)
        self.simulation.let_first(self._is_map_awaited)
        self._declare_panes(workspace)
        self._show_results()
        self.outdated = OutdatedPanes(self.simulation, self.decode, self.window)
        self.outdated.mark_picture(self.image.simulation)
        tell_story(self)
        self.outdated.mark_readings(self.profile, self.decode)
        self.outdated.mark_results(*self.accuracy.of_scene)
        self.shell.made.connect(self._on_made)
        # Before the session is written.
        self.window.closing.connect(self._begin_to_end)
        self.desktop = Desktop(self)
        self.welcome = Welcome(self.window, self.shell, self.preferences, self.files)
        self._match_next, self._front_next = False, True
        self._connect_scene()
        self._connect_settings()
        self._connect_photo()
        self._connect_menus()
        self._connect_slider_strips()
        self._show_first(scene, settings)

    def _declare_panes(self, workspace: Store) -> None:
        self.before = BeforeController(workspace, [self.profile, self.image.before])
        self.pins = PinController(self.store, self.present.is_present)
        self.board = Board()
        self.shell = Shell(self.window, workspace, self.board)
        self.lessons = LessonsInWindow(self.window, self.shell, self.photo_wiring)
        self.video = VideoPane(
            self.window, self.shell, self.files.ask_for_film, self.files.ask_to_save_film
        )
        for feature in features(self):
            self.shell.add(feature)

    def _show_results(self) -> None:
        # The profile follows what is drawn in it: the results before, and the comparison.
        comparison = self.photo_wiring.comparison
        readers = (self.image, comparison, self.profile, self.decode, self.story)
        views = (self.image, self.before, self.pins, self.board, self.accuracy)
        self.simulation.show_in(views, readers)

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
        self.messages.follow(self.accuracy, self.photo)
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
        banners = (self.story.verdict, self.photo.verdict)
        labels = (label for bar in banners for label in (bar.sentence, bar.wrapped))
        self.window.leave_messages_to(*labels)
        self.simulation.failed_for.connect(self.messages.show_failure)
        self.simulation.failed.connect(self.pins.give_up)
        for speaker in (self.presets, self.files, self.present, self.video):
            speaker.status_message.connect(self.window.say)
        for noted in (self.lessons, self.pins):
            noted.status_message.connect(self.messages.show_note)
        self.window.closing.connect(self.stop)

    def _connect_settings(self) -> None:
        self.accuracy.tolerance_edited.connect(self.settings.set_tolerance)
        self.accuracy.observable_chosen.connect(self.settings.set_observable)
        self.accuracy.noise_chosen.connect(self.settings.set_noise)
        self.accuracy.effect_switched.connect(self.store.force)
        self.controls.forced.released.connect(self.store.release_effects)
        self.accuracy.visibility_changed.connect(self.study.set_seen)
        self.accuracy.plan_changed.connect(self.window.show_plan_change)
        self.settings.changed.connect(self._show_settings)
        self.settings.refused.connect(self._refuse_setting)

    def _connect_photo(self) -> None:
        self.photos.failed.connect(self._on_photo_failure)
        self.photos.another_read.connect(self._bring_photo_to_front)
        self.photos.opened.connect(self._on_photo)
        self.photos.begun.connect(self.window.reading.begin)
        self.photos.progressed.connect(self.window.reading.show_progress)
        self.photos.ended.connect(self.window.reading.end)
        self.window.reading.cancelled.connect(self._cancel_photo)
        self.photo.open_asked.connect(self.files.ask_for_photo)
        self.photo.form.edited.connect(self.editor.edit)
        self.photo.result.save_asked.connect(self.presets.ask_to_save_match)
        self.photo.many.save_asked.connect(self.files.ask_to_save_table)
        for copying in (self.photo.many, self.photo.result.paste, self.profile.chips):
            copying.copied.connect(self.window.say)
        self.photo_wiring.matching.matched.connect(self._on_match)
        self.photo_wiring.matching.failed.connect(self.messages.show_match_failure)
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
            "match_all": self.photo_wiring.match_all,
            "find_lamps": self.photo_wiring.lamps.find,
            "region_by_hand": self.photo.lamps.by_hand.toggle,
            "whole_photo": self.photo_wiring.lamps.match_whole,
            "apply_match": self.photo_wiring.matching.apply,
            "save_match": self.presets.ask_to_save_match,
            "use_settings": self.photo_wiring.matching.use_notes,
            "fit": self.image.fit,
            "about": lambda: show_about(self.window),
        }.items():
            self.window.actions_by_name[name].triggered.connect(slot)
        menus = self.window.menus
        self.photo.many.files_shown.connect(self._show_listed)
        self._show_listed()
        menus.scan_axes.triggered.connect(lambda action: self.photos.scan_along(action.data()))
        self.photos.reading_changed.connect(self._show_scan_axis)
        menus.overlays.triggered.connect(lambda action: self.image.set_mode(action.data()))
        self.image.mode_chosen.connect(lambda mode: menus.show_choice(menus.overlays, mode))

    def _connect_slider_strips(self) -> None:
        self.controls.add_foot(self.slider_strips.legend)
        shown = self.window.actions_by_name["slider_strips"]
        shown.toggled.connect(self.slider_strips.set_shown)
        shown.triggered.connect(self.preferences.keep_slider_strips)
        self.slider_strips.set_shown(self.preferences.slider_strips)
        shown.setChecked(self.preferences.slider_strips)
        self.decode.decoder_chosen.connect(self.measuring.slider_strips.choose_decoder)
        self.decode.decoder_chosen.connect(self.simulation.read_with)
        self.decode.decoder_chosen.connect(self.measuring.own_rate.choose_decoder)
        self.measuring.own_rate.changed.connect(self.story.verdict.show_rate)
        self.story.verdict.step_chosen.connect(self._take_step)
        self.story.verdict.lesson_wanted.connect(self._show_lesson)

    @property
    def is_idle(self) -> bool:
        """Whether all requested results are shown."""
        parts = (
            self.simulation, self.outdated, self.photo_wiring, self.desktop, self.pins,
            self.shell,
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

    def _is_map_awaited(self) -> bool:
        pane = self.shell.made_pane("map")
        return pane is not None and pane.map.is_first_answer_awaited

    @property
    def is_measured(self) -> bool:
        """Whether the processes have measured all that is seen."""
        pane = self.shell.made_pane("map")
        return self.measuring.is_idle and (pane is None or pane.is_measured)

    def _on_made(self, _name: str, pane: Pane[Any]) -> None:
        self.outdated.mark_results(*pane.of_picture)

    def _show_lessons(self) -> None:
        self.window.bring_to_front("lessons")

    def _show_lesson(self, name: str) -> None:
        self._show_lessons()
        self.shell.pane("lessons").controller.set_seen(True)
        self.shell.pane("lessons").controller.choose(name)

    def _show_comparison(self) -> None:
        self.window.bring_to_front("compare")

    def _show_several(self, paths: list[Path]) -> None:
        self.photo_wiring.many.show_files(paths)
        self.window.bring_to_front("photo")

    def _show_listed(self) -> None:
        paths = self.photo.many.rows.paths
        self.window.actions_by_name["match_all"].setEnabled(bool(paths))

    def show_mode(self, mode: str) -> None:
        """Show the photo beside the simulated picture or over it, by one of MODES."""
        self.image.set_mode(mode)
        self.window.menus.show_choice(self.window.menus.overlays, mode)

    def _show_scan_axis(self, reading: PhotoReading) -> None:
        self.window.menus.show_choice(self.window.menus.scan_axes, reading.scan_axis)

    def _match(self) -> None:
        self.window.bring_to_front("photo")
        self.photo_wiring.match()

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
        self.accuracy.show_settings(settings)
        self.controls.forced.show_list(forced_text(settings.force, self.settings.effect_labels))

    def _refuse_setting(self, sentence: str) -> None:
        self.accuracy.show_settings(self.settings.settings)
        self.messages.show_refusal(sentence)

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
            self.decode.offer(decoders())
            self.story.offer(decoders())

    def _on_snapshot(self, snapshot: Snapshot) -> None:
        self.messages.end_failure()
        self.window.show_timing(snapshot.simulation_seconds, snapshot.reading_seconds)

    def _take_step(self, step: Step) -> None:
        if step.decoder:
            self.decode.choose_decoder(step.decoder)
        else:
            self.store.change(NO_GESTURE, **step.changes)

    def _bring_photo_to_front(self) -> None:
        if self._front_next:
            self.window.bring_to_front("photo")

    def _on_photo(self, photo: Photo | None) -> None:
        self.messages.end_photo_failure()
        self.window.show_photo_name(None if photo is None else photo.path.name)
        self.window.menus.show_match_found(self.photo_wiring.matching.match is not None)
        self._front_next = True
        if self._match_next:
            self.photo_wiring.match()

    def _on_match(self, _match: Match) -> None:
        self.messages.end_match_failure()
        self.window.menus.show_match_found(True)
        if self._match_next:
            self._match_next = False
            self.photo_wiring.matching.apply()

    def _begin_to_end(self) -> None:
        # What follows waits for work, and somebody may lose patience first.
        self.desktop.autosave.write()
        for who in all_at_work():
            self.window.say(self.tr("{who} is waited for.").format(who=who))
            self.window.repaint()
        self.simulation.stop()  # of the scene that is restored no picture is needed
        self.lessons.end()

    def stop(self) -> None:
        """Stop all work in the background."""
        self.simulation.stop()
        self.study.stop()
        self.photo_wiring.stop()
        self.pins.stop()
        self.shell.stop()
        self.measuring.stop()
        self.desktop.stop()
