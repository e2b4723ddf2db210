"""The pane of the films, declared."""

from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Board
from occ_gui.values.film_choice import FilmChoice


def video(scenes: SceneStore, board: Board) -> Feature[FilmChoice]:
    def make() -> Pane[FilmChoice]:
        from occ_gui.video.wiring import VideoWiring

        return VideoWiring(scenes, board)

    return Feature(
        name="video",
        title="Video",
        help="guide.md#watch-a-film",
        make=make,
        part=lambda workspace, _: workspace.film,
    )
