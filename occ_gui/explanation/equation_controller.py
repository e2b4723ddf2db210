"""Controller of the equations: their present numbers, and the parameters that have just changed."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import QObject

from occ_gui.scene.scene_store import SceneStore
from occ_model.results.teaching import Equation
from occ_model.scene.scene import GROUPS, Scene
from occ_model.teaching.equations import equations

_NAMES = tuple(name for names in GROUPS.values() for name in names)


class EquationController(QObject):
    """Shows the equations with the numbers of the scene, and what has changed, while visible."""

    def __init__(
        self, scenes: SceneStore, show: Callable[[Sequence[Equation], frozenset[str]], None]
    ) -> None:
        super().__init__()
        self._scenes, self._show_equations = scenes, show
        self._is_visible = False
        self._shown_scene: Scene | None = None
        self._only_name = ""
        scenes.changed.connect(self._show)

    def set_visible(self, visible: bool) -> None:
        self._is_visible = visible
        if visible and self._shown_scene != self._scenes.seen:
            self._shown_scene = None  # changes made while hidden are not recent
            self._show(self._scenes.seen)

    def show_only(self, name: str) -> None:
        """Show the equation of this name alone; an empty name shows all."""
        self._only_name, self._shown_scene = name, None
        self._show(self._scenes.seen)

    def _show(self, scene: Scene) -> None:
        if not self._is_visible:
            return
        previous, self._shown_scene = self._shown_scene, scene
        changed = frozenset[str]()
        if previous is not None:
            changed = frozenset(n for n in _NAMES if previous.value(n) != scene.value(n))
        chosen = tuple(e for e in equations(scene) if self._only_name in ("", e.name))
        self._show_equations(chosen, changed)
