"""The pane of the films, declared."""

from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane


def video(scenes: SceneStore) -> Feature[None]:
    """Declare the pane: it shows films, and the film of the scene."""

    def make() -> Pane[None]:
        from occ_gui.video.wiring import VideoWiring

        return VideoWiring(scenes)

    return Feature(
        name="video",
        title="Video",
        help="guide.md#watch-a-film",
        make=make,
    )
