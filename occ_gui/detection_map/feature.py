"""The pane of map, limits and advice, declared."""

from collections.abc import Callable

from occ_gui.detection_map.figures import map_figure
from occ_gui.detection_map.wiring import Measuring
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane


def detection_map(
    scenes: SceneStore, measuring: Measuring, choose_decoder: Callable[[str], None]
) -> Feature[None]:
    """Declare the pane: who goes to a limit of a decoder sees what that one reads."""

    def make() -> Pane[None]:
        from occ_gui.detection_map.pane import MapPane

        pane = MapPane(scenes, measuring)
        pane.went.connect(choose_decoder)
        return pane

    return Feature(
        name="map",
        title="Detection map",
        help="sweeps.md#the-detection-map",
        make=make,
        figures=(map_figure(scenes.store),),
    )
