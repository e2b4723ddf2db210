"""Lesson controller: each step sets its scene, opens its photo and shows its pane."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.files.file_controller import sample_photos
from occ_gui.files.session_record import UserState
from occ_gui.lessons.answers import LessonAnswers, MatchedPhoto
from occ_gui.lessons.changed_scene import changed_sentence
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.photo.kept_photo import KeptPhoto
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.scene.gesture import new_gesture
from occ_gui.scene.scene_store import SceneStore
from occ_gui.widgets.first_periods import PACKETS_IN_VIEW
from occ_gui.widgets.plain_text import LONGEST
from occ_model.errors import OccError, one_line
from occ_model.photo.reading.load import Photo
from occ_model.results.lessons import Lesson, LessonList, Step
from occ_model.results.match import Match
from occ_model.teaching.explanations import explanation
from occ_model.teaching.lessons import lessons
from occ_model.teaching.quantities import QUANTITIES
from occ_model.teaching.rolling_shutter import rolling_shutter


class LessonController(QObject):
    """Goes from step to step, and keeps the steps reached while the window is open.

    A lesson begins with the window's first settings and no forced effects; when it ends,
    the user's own scene, settings and photo are restored.

    Parameters
    ----------
    scenes
        The store of the scene.
    photos
        Opens the photo of a step.
    pane
        Shows the lessons.
    answers
        Checks and keeps the answers.
    """

    status_message = Signal(str)
    """The reason why a step is incomplete."""

    begun = Signal()
    """A lesson is about to replace what the user is working on."""

    pane_wanted = Signal(str)
    """The name of the pane that a step refers to; empty for none."""

    control_wanted = Signal(str)
    """The name of the parameter that a step is about; empty for none."""

    columns_held = Signal(object)
    """How many columns a step keeps in view, so that a change of the scene is seen as such; None
    for as many as usual."""

    equation_wanted = Signal(str)
    """The name of the equation that explains a step; empty for none."""

    frequency_told = Signal(float)
    """The switching frequency in Hz of the sample photo that a step has opened."""

    action_wanted = Signal(str)
    """What a step has a button for, as the step names it."""

    report_asked = Signal(Lesson)
    """The lesson whose report is to be written."""

    def __init__(
        self,
        scenes: SceneStore,
        photos: PhotoController,
        pane: LessonView,
        answers: LessonAnswers,
    ) -> None:
        super().__init__()
        self._scenes = scenes
        self._photos = photos
        self._pane = pane
        self._answers = answers
        self._all = LessonList(())
        self._current: Lesson | None = None
        self._done: dict[str, int] = {}
        self._places: dict[str, int] = {}
        self._open: Path | None = photos.path  # opened before this pane was first shown
        self._user: UserState | None = None
        self._last: Lesson | None = None
        self._match: Callable[[], Match | None] = lambda: None
        self._keep_photo: Callable[[], KeptPhoto | None] = lambda: None
        self._give_back: Callable[[KeptPhoto], None] = lambda _kept: None
        self._kept: KeptPhoto | None = None
        photos.opened.connect(self._note_photo)
        answers.checked.connect(self._show_checked)
        scenes.changed.connect(self._follow_scene)
        pane.list.chosen.connect(self.choose)
        pane.list_asked.connect(self.leave)
        pane.step.moved.connect(self.go)
        pane.step.again_asked.connect(self.set_again)
        pane.step.control_asked.connect(self._want_control)
        pane.step.answer_given.connect(self._check)
        pane.step.action_asked.connect(self._ask_action)
        pane.end.report_asked.connect(self._ask_report)
        pane.end.next_asked.connect(self._go_to_following)

    def use_match(self, match: Callable[[], Match | None]) -> None:
        """Compare answers about a photo with the match that this function gives."""
        self._match = match

    def keep_photos_by(
        self, keep: Callable[[], KeptPhoto | None], give_back: Callable[[KeptPhoto], None]
    ) -> None:
        """Keep the user's photo by one function, and show it again by the other one."""
        self._keep_photo, self._give_back = keep, give_back

    def set_seen(self, seen: bool) -> None:
        """Read the lessons when their pane is shown, unless one is under way."""
        if seen and self._current is None and self._last is None:
            failure = ""
            try:
                self._all = lessons()
            except OccError as error:
                failure = one_line(str(error), LONGEST)
            except Exception as error:  # noqa: BLE001 - the window works whatever they contain
                reason = one_line(f"{type(error).__name__}: {error}")
                failure = f"The lessons cannot be read: {reason}."
            self._pane.list_lessons(
                self._all.lessons, self._places | self._done, failure, self._all.problems
            )

    def begin_first(self) -> None:
        """Begin the first lesson."""
        self.set_seen(True)
        if self._all.lessons:
            self.choose(self._all.lessons[0].name)

    def choose(self, name: str) -> None:
        """Continue a lesson at the step reached."""
        for lesson in self._all.lessons:
            if lesson.name == name:
                self._begin()
                self._current, self._last = lesson, None
                self._go(self._places.get(name, 0))

    def go(self, steps: int) -> None:
        """Go forward or back by some steps; after the last one end the lesson."""
        if self._current is None:
            return
        name, count = self._current.name, len(self._current.steps)
        place = self._places[name] + steps
        if place < count:
            self._go(max(place, 0))
            return
        self._done[name] = count
        self._places[name] = 0
        self._last, self._current = self._current, None
        self.control_wanted.emit("")
        self.restore_user()
        self._show_end(self._last)

    def _show_end(self, done: Lesson) -> None:
        given = [each.answer for each in self._answers.all_of(done)]
        following = self._following()
        self._pane.show_end(done, given, "" if following is None else following.title)
        self._pane.end.report.setEnabled(not self._answers.is_checking(done))

    def _following(self) -> Lesson | None:
        """Return the lesson that follows in the list on the one that is done, None after the last.

        A file that has been removed or renamed meanwhile has none after it.
        """
        if self._last is not None and self._last in self._all.lessons:
            rest = self._all.lessons[self._all.lessons.index(self._last) + 1 :]
            return next(iter(rest), None)
        return None

    def _go_to_following(self) -> None:
        following = self._following()
        if following is not None:
            self.choose(following.name)

    def leave(self) -> None:
        """End the lesson and return to the list; the step reached is kept."""
        self._current = self._last = None
        self.control_wanted.emit("")
        self.restore_user()
        self._pane.list_lessons(
            self._all.lessons, self._places | self._done, "", self._all.problems
        )

    def users_own(self) -> UserState | None:
        """Return what the end of the lesson restores; None where none is under way."""
        if self._user is None or not self._shows_own_photo:
            return self._user
        return replace(self._user, photo=self._open)  # opened meanwhile: it stays

    def _begin(self) -> None:
        if self._user is None:
            self.begun.emit()
            settings = self._scenes.settings.settings
            self._user = UserState(self._scenes.scene, settings, self._open)
            self._kept = self._keep_photo()
            self._scenes.settings.restore(FIRST_SETTINGS)

    def restore_user(self) -> None:
        """Restore what the user was working on; the scene in one step that can be undone."""
        user, self._user = self.users_own(), None
        kept, self._kept = self._kept, None
        self.columns_held.emit(None)
        if user is None:
            return
        self._scenes.settings.restore(user.settings)
        title = "end of the lesson"
        self._scenes.put(user.scene, title, new_gesture(), force=user.settings.force)
        self._return_photo(user.photo, kept)
        self.pane_wanted.emit("")

    def _return_photo(self, photo: Path | None, kept: KeptPhoto | None) -> None:
        """Open the photo again that was open before the lesson."""
        self._give_up_sample()
        if self._open == photo and photo not in sample_photos():
            return  # with what the user has found in it meanwhile
        if photo is None:
            self._photos.close()
        elif kept is not None and kept.photo.path == photo:
            self._give_back(kept)  # with what was found in it: a photo read anew has no match
        else:
            self._photos.open(photo)

    def set_again(self) -> None:
        """Set the scene of the step again, undoing all changes to it."""
        if self._current is not None:
            self._set(self._current, self._places[self._current.name])

    def _go(self, place: int) -> None:
        lesson = self._current
        if lesson is None:
            return
        self._places[lesson.name] = place
        self._done.pop(lesson.name, None)
        step = lesson.steps[place]
        self._pane.show_step(lesson, place, self._answers.of(lesson, place))
        self.equation_wanted.emit(step.equation)
        self._set(lesson, place)
        self.control_wanted.emit(step.control)
        self._follow_scene()

    def _set(self, lesson: Lesson, place: int) -> None:
        step = lesson.steps[place]
        self._scenes.settings.restore(FIRST_SETTINGS)  # not the tolerance of the step before
        title = f"step {place + 1} of “{lesson.title}”"
        self._scenes.put(step.scene, title, new_gesture(), force={})
        packet = QUANTITIES["packet-columns"].compute(step.scene, "")
        self.columns_held.emit(PACKETS_IN_VIEW * packet)
        self._open_photo(step)
        self.pane_wanted.emit(step.pane)

    def _open_photo(self, step: Step) -> None:
        samples = {path.stem: path for path in sample_photos()}
        wanted = samples.get(step.photo)
        if step.own_photo and self._show_users_photo():
            return  # which the sample would stand in for
        if step.photo and wanted is None:
            self.status_message.emit(f"The photo {step.photo} is missing.")
        elif wanted is not None and wanted == self._open:
            self._tell_frequency(step)
        elif wanted is not None:
            self._photos.open(wanted)
        elif not step.photo:
            self._give_up_sample()
            self._put_photo_aside()

    def _show_users_photo(self) -> bool:
        """Show the user's own photo, if there is one; return whether there is."""
        if self._open is None and self._kept is not None:
            self._give_back(self._kept)
        return self._shows_own_photo

    @property
    def _shows_own_photo(self) -> bool:
        """Whether a photo of the user's own is open, and no sample."""
        return self._open not in {None, *sample_photos()}

    def _put_photo_aside(self) -> None:
        """Close a sample, or the photo that was open before the lesson, which its end restores."""
        if self._shows_own_photo:
            if self._user is None or self._open != self._user.photo:
                return  # opened during the lesson
            self._kept = self._keep_photo()  # with what has been found in it meanwhile
        if self._open is not None:
            self._photos.close()

    def _give_up_sample(self) -> None:
        """Read no more the sample of a step that is left: it would be opened after it."""
        if self._photos.awaited in sample_photos():
            self._photos.cancel()

    def _note_photo(self, photo: Photo | None) -> None:
        self._open = None if photo is None else photo.path
        step = self._step()
        if step is not None:
            self._tell_frequency(step)

    def _tell_frequency(self, step: Step) -> None:
        """Tell what a step says of the sample that it shows: how fast its lamp switches."""
        if step.photo and self._open in sample_photos() and self._open.stem == step.photo:
            self.frequency_told.emit(step.scene.transmitter.switching_frequency)

    @property
    def lesson_under_way(self) -> Lesson | None:
        """The lesson under way, None while there is none."""
        return self._current

    def _step(self) -> Step | None:
        """Return the step under way."""
        lesson = self._current
        return None if lesson is None else lesson.steps[self._places[lesson.name]]

    def _want_control(self) -> None:
        step = self._step()
        self.control_wanted.emit("" if step is None else step.control)

    def _follow_scene(self) -> None:
        step = self._step()
        if step is None:
            return
        scene = self._scenes.scene
        self._pane.step.show_changed(changed_sentence(step, scene))
        self._pane.step.show_explanation(explanation(step, scene))
        self._mark_answer()
        if step.animation:
            self._pane.step.animation.show_shutter(rolling_shutter(self._scenes.scene))

    def _mark_answer(self) -> None:
        """Say of an answer that was checked at another scene that it was."""
        lesson = self._current
        if lesson is not None:
            place = self._places[lesson.name]
            self._pane.step.answer_field.show_outdated(
                not self._answers.is_at(lesson, place, self._scenes.scene)
            )

    def _check(self, text: str) -> None:
        lesson = self._current
        if lesson is not None:
            self._pane.step.answer_field.show_waiting()
            name = "" if self._open is None else one_line(self._open.name)
            photo = MatchedPhoto(name, self._match())
            self._answers.check(lesson, self._places[lesson.name], text, self._scenes.scene, photo)

    def _show_checked(self, lesson: Lesson, place: int) -> None:
        answer = self._answers.of(lesson, place)
        if lesson is self._current and place == self._places[lesson.name] and answer is not None:
            self._pane.step.answer_field.show_checked(answer)
            self._mark_answer()
        if lesson is self._last:  # its end is shown already, before this answer was checked
            self._show_end(lesson)

    def _ask_action(self) -> None:
        step = self._step()
        if step is not None:
            self.action_wanted.emit(step.action)

    def _ask_report(self) -> None:
        if self._last is not None:
            self.report_asked.emit(self._last)
