"""The pane of the bars, declared."""

from typing import TYPE_CHECKING

from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Draw, Feature, Figure, Pane
from occ_gui.simulation.snapshot import Snapshot
from occ_model.scene.scene import Scene

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing


def bands(scenes: SceneStore) -> Feature[Scene]:
    """Declare the pane: it shows the bars of the present scene, and changes its exposure."""

    def make() -> Pane[Scene]:
        from occ_gui.bands.pane import BandsPane

        return BandsPane(scenes)

    return Feature(
        name="bands",
        title="Bars",
        help="bands.md",
        make=make,
        part=lambda workspace, _: workspace.scene,
        figures=bands_figures(),
    )


def bands_figures() -> tuple[Figure, ...]:
    def bars(_pane: object, shown: Snapshot) -> Draw:
        def draw() -> "Drawing":
            from occ_model.figures.bands import bands_drawing

            return bands_drawing(shown.frame.scene)

        return draw

    def flicker(_pane: object, shown: Snapshot) -> Draw:
        def draw() -> "Drawing":
            from occ_model.figures.bands import flicker_drawing

            return flicker_drawing(shown.frame.scene)

        return draw

    return (
        Figure(name="bands", title="Bars", draw=bars),
        Figure(name="flicker", title="Flicker for the eye", draw=flicker),
    )
