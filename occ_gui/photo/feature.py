"""The pane of the photo, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.photo.photo_controller import PhotoController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Board
from occ_gui.simulation.snapshot import Reading

if TYPE_CHECKING:
    from occ_gui.picture.image_view import ImageView


def photo(
    scenes: SceneStore, photos: PhotoController, image: "Callable[[], ImageView]", board: Board
) -> Feature[Reading | None]:
    """Declare the pane: a photo is shown with the picture, which ``image`` gives."""

    def make() -> Pane[Reading | None]:
        from occ_gui.photo.wiring import PhotoWiring

        return PhotoWiring(scenes, photos, image(), board)

    return Feature(
        name="photo",
        title="Photo",
        help="photos.md",
        make=make,
        part=lambda _, results: results.reading,
        goes_on_hidden=True,
    )
