"""Learning panes: equations, comparison and lessons, created on demand in docks."""

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDockWidget, QWidget

from occ_gui.files.preferences import Preferences
from occ_gui.files.session_record import UserState
from occ_gui.photo.wiring import PhotoWiring
from occ_gui.picture.before_controller import BeforeController
from occ_gui.picture.image_view import ImageView
from occ_gui.pins.pin_controller import PinController
from occ_gui.pins.pinned import Pinned
from occ_gui.profile.profile_view import ProfileView
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.scene_store import SceneStore
from occ_gui.simulation.snapshot import SimulationRequest, Snapshot
from occ_gui.widgets.lazy_pane import LazyPane, PaneContent

if TYPE_CHECKING:
    from occ_gui.explanation.wiring import ExplanationWiring
    from occ_gui.lessons.lesson_view import LessonView
    from occ_gui.lessons.wiring import LessonWiring
    from occ_gui.pins.compare_view import CompareView
    from occ_gui.spectrum.controller import SpectrumController
    from occ_gui.spectrum.spectrum_view import SpectrumView


_ENTRY_OF_ACTION = {"transmitter": "transmitter", "photo": "open_photo", "match": "match"}
"""The menu entries that the buttons of lessons stand for."""


class DockWindow(Protocol):
    """A window that panes can be added to."""

    @property
    def actions_by_name(self) -> Mapping[str, QAction]:
        """The menu entries, by name."""

    def add_pane(self, name: str, title: str, content: QWidget) -> QDockWidget:
        """Add a pane before the window is shown."""

    def bring_to_front(self, name: str) -> None:
        """Show a pane in front of those that share its place."""

    def bring_into_view(self, name: str) -> None:
        """Show a pane in front, unless what it shows is seen already."""

    def put_away(self, name: str) -> None:
        """Hide a pane that the present mode does not show by itself."""

    def is_put_away(self, name: str) -> bool:
        """Return whether a pane is hidden."""


class LearningPanes(QObject):
    """The panes that explain and compare, with their controllers, in docks of a window.

    Each pane is created when it is first shown.

    Parameters
    ----------
    window
        The window that the docks are added to.
    scenes
        The store of the scene.
    photos
        Opens the photos of the lessons, and matches them.
    image, profile
        The panes that show the results before the last change; columns are selected in the
        profile.
    controls
        The controls, of which a lesson marks one.
    preferences
        Stores the folder of a lesson's report.
    """

    status_message = Signal(str)
    """The outcome of an action, shown until the scene changes."""

    exposure_chooser_made = Signal(QObject)
    """The controller has been created that chooses the column whose exposure is shown."""

    lesson_begun = Signal()
    """A lesson is about to replace what the user is working on."""

    columns_held = Signal(object)
    """How many columns a lesson keeps in view; None for as many as usual."""

    photo_explained = Signal(bool)
    """Whether the step of a lesson that is shown is about the photo."""

    exposure_made = Signal(QWidget)
    """A pane has been created that shows results."""

    def __init__(
        self,
        window: DockWindow,
        scenes: SceneStore,
        photos: PhotoWiring,
        image: ImageView,
        profile: ProfileView,
        *,
        controls: ControlPanel,
        preferences: Preferences,
    ) -> None:
        super().__init__()
        self._window = window
        self._scenes, self._photos = scenes, photos
        self._profile = profile
        self._controls, self._preferences = controls, preferences
        self._snapshot: Snapshot | None = None
        self._brought = ""
        """The pane that a step has opened; empty for none."""
        self.before = BeforeController(scenes.store, [profile, image.before])
        self.pins = PinController(scenes, self, self._is_present)
        self._add_docks()
        self._connect_menus()

    @cached_property
    def explanation(self) -> "ExplanationWiring":
        """The equations and the exposure of a column."""
        from occ_gui.explanation.wiring import ExplanationWiring

        explanation = ExplanationWiring(self._scenes, self._profile.plot)
        if self._snapshot is not None:
            explanation.show_snapshot(self._snapshot)
        self.exposure_made.emit(explanation.pane.exposure)
        self.exposure_chooser_made.emit(explanation.exposure)
        return explanation

    @cached_property
    def compare(self) -> "CompareView":
        """The differences between the pinned states A and B."""
        from occ_gui.pins.compare_view import CompareView

        view = CompareView()
        view.pin_asked.connect(self.pins.pin)
        view.go_asked.connect(self.pins.go_to)
        view.clear_asked.connect(self.pins.clear)
        view.show_pinned(self.pins.pinned)
        return view

    @cached_property
    def spectrum(self) -> "SpectrumView":
        """The spectrum of the profile and the histogram of the picture."""
        from occ_gui.spectrum.spectrum_view import SpectrumView

        view = SpectrumView()
        self.exposure_made.emit(view)
        return view

    @cached_property
    def spectrum_controller(self) -> "SpectrumController":
        """The controller of the spectrum, connected with its pane."""
        from occ_gui.spectrum.controller import SpectrumController

        controller = SpectrumController(self.spectrum)
        if self._snapshot is not None:
            controller.show_snapshot(self._snapshot)
        return controller

    @cached_property
    def lessons_pane(self) -> "LessonView":
        """The pane of the lessons."""
        from occ_gui.lessons.lesson_view import LessonView

        return LessonView()

    @cached_property
    def lessons(self) -> "LessonWiring":
        """The lessons, connected with their pane."""
        from occ_gui.lessons.wiring import LessonWiring

        wiring = LessonWiring(
            self._scenes, self._photos.photos, self.lessons_pane, self._controls, self._preferences
        )
        wiring.status_message.connect(self.status_message)
        wiring.controller.pane_wanted.connect(self._show_pane_of_step)
        wiring.controller.begun.connect(self.lesson_begun)
        wiring.controller.columns_held.connect(self.columns_held)
        wiring.controller.action_wanted.connect(self._do)
        wiring.controller.use_match(lambda: self._photos.matching.match)
        wiring.controller.frequency_told.connect(self._photos.begin_form)
        wiring.controller.keep_photos_by(self._photos.kept, self._photos.give_back)
        return wiring

    def _do(self, action: str) -> None:
        """Do what a step of a lesson has a button for: an entry of the menus."""
        self._window.actions_by_name[_ENTRY_OF_ACTION[action]].trigger()

    def _show_pane_of_step(self, name: str) -> None:
        """Show the pane that a step refers to, in place of the one that an earlier step opened."""
        if self._brought not in {"", name}:  # beside it the next one might need a larger screen
            self._window.put_away(self._brought)
            self._brought = ""
        if name:
            is_new = self._window.is_put_away(name)
            self._window.bring_into_view(name)
            if is_new and not self._window.is_put_away(name):
                self._brought = name
        self.photo_explained.emit(name == "photo")

    def users_own(self) -> UserState | None:
        """Return what the user was working on, if a lesson is under way."""
        return self.lessons.controller.users_own() if "lessons" in vars(self) else None

    def end_lesson(self) -> None:
        """Restore what the user was working on, if a lesson is under way."""
        if "lessons" in vars(self):
            self.lessons.end()

    @property
    def is_idle(self) -> bool:
        """Whether all answers are checked, all reports written, and all pins restored."""
        return self.pins.is_idle and ("lessons" not in vars(self) or self.lessons.is_idle)

    def stop(self) -> None:
        """Stop all work in the background."""
        self.pins.stop()
        if "lessons" in vars(self):
            self.lessons.stop()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Pass new results on to the panes and controllers that use them."""
        self._snapshot = snapshot
        self.before.show_snapshot(snapshot)
        self.pins.show_snapshot(snapshot)
        if "explanation" in vars(self):
            self.explanation.show_snapshot(snapshot)
        if "spectrum_controller" in vars(self):
            self.spectrum_controller.show_snapshot(snapshot)

    def show_pinned(self, pinned: Pinned) -> None:
        """Show the pinned states in the comparison, if that pane has been created."""
        if "compare" in vars(self):
            self.compare.show_pinned(pinned)

    def _is_present(self, snapshot: Snapshot) -> bool:
        present = SimulationRequest(self._scenes.scene, self._scenes.settings.settings)
        return snapshot.request == present

    def _add_docks(self) -> None:
        add = self._add_dock
        add("equations", self.tr("Equations"), self._explain)
        add("spectrum", self.tr("Spectrum and levels"), self._analyse)
        add("compare", self.tr("Compare"), self._compare)
        add("lessons", self.tr("Lessons"), self._learn)

    def _add_dock(self, name: str, title: str, make: Callable[[], PaneContent]) -> None:
        pane = LazyPane(make)
        dock = self._window.add_pane(name, title, pane)
        dock.visibilityChanged.connect(pane.set_seen)

    def _explain(self) -> PaneContent:
        return self.explanation.pane, self.explanation.set_seen

    def _compare(self) -> PaneContent:
        return self.compare, self.compare.set_seen

    def _analyse(self) -> PaneContent:
        return self.spectrum, self.spectrum_controller.set_seen

    def _learn(self) -> PaneContent:
        return self.lessons_pane, self.lessons.controller.set_seen

    def _connect_menus(self) -> None:
        actions = self._window.actions_by_name
        for name, shown in (("a", "A"), ("b", "B")):
            actions[f"pin_{name}"].triggered.connect(
                lambda _=False, shown=shown: self.pins.pin(shown)
            )
            actions[f"go_to_{name}"].triggered.connect(
                lambda _=False, shown=shown: self.pins.go_to(shown)
            )
        actions["clear_pins"].triggered.connect(self.pins.clear)
        actions["lessons"].triggered.connect(lambda: self._window.bring_to_front("lessons"))
        self.pins.status_message.connect(self.status_message)
        # Not by a lambda: the signal would hold it, and it this object, beyond the window's end.
        self.pins.both_pinned.connect(self._show_comparison)

    def _show_comparison(self) -> None:
        self._window.bring_to_front("compare")
