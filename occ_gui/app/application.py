"""Application: connects the parts of the window, and adds its panes."""

from typing import Any

from PySide6.QtCore import QSettings

from occ_gui.app.features import features
from occ_gui.app.parts import Parts
from occ_gui.app.scene_in_window import SceneInWindow
from occ_gui.app.story_wiring import connect_story
from occ_gui.core.workspace import Workspace
from occ_gui.files.file_controller import sample_photos
from occ_gui.files.session import Session
from occ_gui.shell.feature import Pane
from occ_gui.shell.outdated_marks import OutdatedMarks
from occ_gui.window.docks import CurrentPane
from occ_model.scene.parameters import PARAMETERS


class Application(Parts):
    def __init__(self, workspace: Workspace, preferences: QSettings | None = None) -> None:
        super().__init__(workspace, preferences)
        for feature in features(self):
            self.shell.add(feature, self.window)
        # After the panes, so that these change before their marks do.
        self.outdated = OutdatedMarks(self.results_store, self.simulation, self.window)
        self.outdated.mark_pane("story", self.shell.pane("story"))
        self.shell.made.connect(self.outdated.mark_pane)
        self.current_pane = CurrentPane(self.window, self.window.docks)
        self._offer_exports()
        self.shell.enable_entries()
        connect_story(self)
        self.scene = SceneInWindow(self)
        self._code_selection = self.scene_store.store.select(lambda workspace: workspace.has_code)
        self.session = Session(self.scene_store.store, self._user_workspace)
        self._connect_parts()

    def _offer_exports(self) -> None:
        menus, figures = self.window.menus, self.shell.figures.values()
        titles = {figure.name: figure.title for figure in figures}
        menus.add_figures(titles, lambda name: self.shell.pane("export").ask(name))
        sliders = {name: PARAMETERS[name].label for name in self.controls.main_rows()}
        menus.add_animations(sliders, self._animate)
        self.controls.player.animation_asked.connect(self._animate)

    def _connect_parts(self) -> None:
        window, story = self.window, self.story
        # Messages about more than the present scene stay until the next one.
        for signal in (self.error_reports.reported, self.session.status_message):
            signal.connect(self.messages.say)
        for signal in (
            self.presets.status_message, self.files.status_message, self.shell.status_message,
            self.present_results.status_message, self.editor.brightness.status_message,
            self.pins.status_message, self.lessons.noted,
        ):  # fmt: skip
            signal.connect(self.messages.note)
        for failed in (self.files.failed, self.shell.file_failed):
            failed.connect(self.messages.say_file_failure)
        window.leave_messages_to(story.verdict.sentence, story.verdict.wrapped)
        for step in (self._prepare_to_close, self.session.end, self.stop):
            window.closing.connect(step)
        self.session.written.connect(self._keep_view)
        self.shell.accepted.connect(self.messages.accept)
        self.shell.made.connect(self._on_pane_made)
        self._connect_photos()
        window.dropped.connect(self.files.open_dropped)
        window.may_close = self.document.may_close
        window.menus.show_samples(sample_photos(), self.files.open_sample)
        self.controls.player.run_changed.connect(self.outdated.follow_run)
        self.pins.both_pinned.connect(self._show_comparison)
        story.verdict.lesson_requested.connect(self._show_lesson)
        story.verdict.colours_requested.connect(lambda: window.bring_to_front("colour"))
        self.background_rates.rate_changed.connect(story.verdict.show_rate)
        self._connect_strips()
        window.modes.changed.connect(self._show_bars)
        self._code_selection.changed.connect(self._show_bars)
        entries = window.actions_by_name
        entries["undo"].triggered.connect(self._report_undo)
        entries["redo"].triggered.connect(self._report_redo)

    def _on_pane_made(self, _name: str, pane: Any) -> None:
        if isinstance(pane, Pane):
            self.window.leave_messages_to(*pane.sentences)

    def _connect_photos(self) -> None:
        window, photos, menus = self.window, self.photos, self.window.menus
        photos.loading.begun.connect(self._make_photo_pane)
        photos.loading.begun.connect(window.loading_bar.begin)
        photos.loading.task.reported.connect(window.loading_bar.show_progress)
        photos.loading.ended.connect(window.loading_bar.end)
        window.loading_bar.cancelled.connect(photos.cancel)
        photos.failed.connect(self.messages.say_photo_failure)
        photos.opened.connect(self.document.show_photo)
        self.document.photo_named.connect(window.show_photo)
        self.files.pane_requested.connect(window.bring_to_front)
        menus.scan_axes.triggered.connect(lambda action: photos.set_scan_axis(action.data()))
        scan_axis = self.scene_store.store.select(
            lambda workspace: workspace.photo.load_options.scan_axis
        )
        scan_axis.changed.connect(lambda axis: menus.show_choice(menus.scan_axes, axis))

    def _make_photo_pane(self) -> None:
        self.shell.pane("photo")  # before the photo is read

    def _report_undo(self) -> None:
        # The change may be invisible in this mode. Menu texts contain && for &.
        title = self.scene_store.undo_stack.redoText().replace("&&", "&")
        self.messages.note(f"Undone: {title}.")

    def _report_redo(self) -> None:
        title = self.scene_store.undo_stack.undoText().replace("&&", "&")
        self.messages.note(f"Redone: {title}.")

    def _connect_strips(self) -> None:
        self.controls.add_foot(self.slider_strips.legend)
        entry = self.window.actions_by_name["slider_strips"]
        entry.triggered.connect(self.preferences.keep_slider_strips)
        entry.setChecked(self.preferences.slider_strips)
        entry.toggled.connect(self._show_strips)
        self._code_selection.changed.connect(self._show_strips)
        self._show_strips()

    def _show_bars(self) -> None:
        """Bring the bars to the front among the panes on limits while no code is sent."""
        if self.window.modes.mode == "limits" and not self._code_selection.value:
            self.window.bring_to_front("bands")

    def _show_strips(self) -> None:
        """Show the strips if the user wants them, and a code is sent."""
        entry, is_code = self.window.actions_by_name["slider_strips"], self._code_selection.value
        entry.setEnabled(is_code)
        self.slider_strips.set_visible(entry.isChecked() and is_code)

    @property
    def is_idle(self) -> bool:
        parts = (self.simulation.task, self.outdated, self.pins, self.shell)
        return all(part.is_idle for part in parts)

    @property
    def is_measured(self) -> bool:
        return self.background_rates.is_idle and self.shell.is_measured

    def resume(self, workspace: Workspace) -> None:
        """Restore the workspace of an earlier window, without a step to undo."""
        self.scene_store.store.put(workspace)

    def _user_workspace(self) -> Workspace:
        """Return the user's own workspace, even while a lesson shows another."""
        return self.lessons.user_workspace() or self.scene_store.store.workspace

    def _keep_view(self) -> None:
        """Store the layout of the window, unless a lesson has its own panes in it."""
        if self.lessons.user_workspace() is None:
            self.options.layout.keep()

    def _animate(self, name: str) -> None:
        self.shell.pane("animation").ask(name)

    def _show_comparison(self) -> None:
        self.window.bring_to_front("compare")

    def _show_lesson(self, name: str) -> None:
        self.window.bring_to_front("lessons")
        lessons = self.shell.pane("lessons").controller
        lessons.set_visible(True)
        lessons.choose(name)

    def _prepare_to_close(self) -> None:
        # First, because the next steps wait for work, and the user may kill the program.
        self.session.write()
        self.simulation.stop()  # the scene that is restored needs no picture
        self.lessons.end()

    def stop(self) -> None:
        for part in (self.simulation, self.pins.task, self.shell, self.background_rates):
            part.stop()
        self.error_reports.remove()
