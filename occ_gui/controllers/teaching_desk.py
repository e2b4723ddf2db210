"""All that shows what changed and why, put together: before, pins, equations, explorations."""

from collections.abc import Mapping
from typing import Protocol

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDockWidget, QWidget

from occ_gui.controllers.before import BeforeController
from occ_gui.controllers.equations import EquationController
from occ_gui.controllers.explorations import ExplorationController
from occ_gui.controllers.exposure_column import ExposureController
from occ_gui.controllers.photo import PhotoController
from occ_gui.controllers.pins import PinController
from occ_gui.state.scene_store import SceneStore
from occ_gui.state.snapshot import Snapshot
from occ_gui.views.column_picker import ColumnPicker
from occ_gui.views.compare_view import CompareView
from occ_gui.views.explanation_view import ExplanationView
from occ_gui.views.exploration_view import ExplorationView
from occ_gui.views.image_view import ImageView
from occ_gui.views.profile_view import ProfileView


class DockWindow(Protocol):
    """A window that takes docks."""

    @property
    def actions_by_name(self) -> Mapping[str, QAction]:
        """The entries of its menus."""

    def add_pane(
        self, name: str, title: str, content: QWidget, *, behind: str = "", below: str = ""
    ) -> QDockWidget:
        """Add a pane before the window is shown."""

    def bring_to_front(self, name: str) -> None:
        """Show a pane before those that share its place."""


class TeachingDesk(QObject):
    """The panes that explain and compare, with their controllers, as docks of a window.

    Parameters
    ----------
    window
        Gets the docks.
    scenes
        The scene.
    photos
        Opens the photos of explorations.
    image, profile
        The panes that show what was before, and where a column is pointed at.
    """

    said = Signal(str)
    """What was done, or why it was not; until the scene changes."""

    def __init__(
        self,
        window: DockWindow,
        scenes: SceneStore,
        photos: PhotoController,
        image: ImageView,
        profile: ProfileView,
    ) -> None:
        super().__init__()
        self._window = window
        self.explanation, self.compare = ExplanationView(), CompareView()
        self.exploring = ExplorationView()
        self.before = BeforeController(scenes, [profile, image.before])
        self.pins = PinController(scenes, self.compare)
        self.equations = EquationController(scenes, self.explanation.equations)
        self.picker = ColumnPicker(profile.plot)
        self.exposure = ExposureController(self.explanation.exposure, self.picker)
        self.explorations = ExplorationController(scenes, photos, self.exploring)
        self._add_docks()
        self._connect_pins()
        self._connect_column()
        self._connect_explorations()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Hand these results to all that make use of them."""
        for part in (self.before, self.pins, self.exposure):
            part.show_snapshot(snapshot)

    def _add_docks(self) -> None:
        add = self._window.add_pane
        equations = add("equations", self.tr("Equations"), self.explanation, behind="decode")
        equations.visibilityChanged.connect(self.equations.set_seen)
        equations.visibilityChanged.connect(self.exposure.set_seen)
        compare = add("compare", self.tr("Compare"), self.compare, behind="profile")
        compare.visibilityChanged.connect(self.compare.set_seen)
        guide = add("explorations", self.tr("Explorations"), self.exploring, below="controls")
        guide.visibilityChanged.connect(self.explorations.set_seen)

    def _connect_pins(self) -> None:
        for name, shown in (("pin_a", "A"), ("pin_b", "B")):
            action = self._window.actions_by_name[name]
            action.triggered.connect(lambda _=False, shown=shown: self.pins.pin(shown))
        for name, shown in (("go_to_a", "A"), ("go_to_b", "B")):
            action = self._window.actions_by_name[name]
            action.triggered.connect(lambda _=False, shown=shown: self.pins.go_to(shown))
        self._window.actions_by_name["clear_pins"].triggered.connect(self.pins.clear)
        self.compare.pin_asked.connect(self.pins.pin)
        self.compare.go_asked.connect(self.pins.go_to)
        self.compare.clear_asked.connect(self.pins.clear)
        self.pins.said.connect(self.said)

    def _connect_column(self) -> None:
        self.picker.hovered.connect(self.exposure.hover)
        self.picker.clicked.connect(self.exposure.click)
        self.picker.stepped.connect(self.exposure.step)
        self.picker.released.connect(lambda: self.exposure.hold(False))
        self.explanation.exposure.column_chosen.connect(self.exposure.choose)
        self.explanation.exposure.hold_chosen.connect(self.exposure.hold)

    def _connect_explorations(self) -> None:
        self._window.actions_by_name["explorations"].triggered.connect(
            lambda: self._window.bring_to_front("explorations")
        )
        self.exploring.chosen.connect(self.explorations.choose)
        self.exploring.moved.connect(self.explorations.go)
        self.exploring.list_asked.connect(self.explorations.leave)
        self.exploring.again_asked.connect(self.explorations.set_again)
        self.explorations.said.connect(self.said)
        self.explorations.pane_wanted.connect(self._window.bring_to_front)
