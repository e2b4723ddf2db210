"""The pane of the equations, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.widgets.plot import Plot


def equations(scenes: SceneStore, profile: "Callable[[], Plot]") -> Feature[Snapshot]:
    """Declare the pane; in the plot of the profile the user picks the column that it explains."""

    def make() -> Pane[Snapshot]:
        from occ_gui.explanation.pane import ExplanationPane

        return ExplanationPane(scenes, profile())

    return Feature(
        name="equations",
        title="Equations",
        help="model.md",
        make=make,
        part=lambda _, results: results.snapshot,
    )
