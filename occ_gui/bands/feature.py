"""The pane of the bars, declared."""

from occ_gui.bands.figures import bands_figures
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane
from occ_model.scene.scene import Scene


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
