"""The pane of the photo, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.core.workspace import Workspace
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Board, Results

if TYPE_CHECKING:
    from occ_gui.photo.pane import PhotoPane
    from occ_gui.photo.photo_part import PhotoPart
    from occ_gui.picture.image_view import ImageView


def photos(pane: "Callable[[], PhotoPane]") -> Feature[None]:
    """Declare the pane of several photos, whose table is that of the pane of one."""
    return Feature(
        name="photos",
        title="Photos",
        help="photos.md#many-photos-one-answer",
        make=lambda: Pane[None](pane().view.many),
    )


def photo(
    scenes: SceneStore, photos: PhotoController, image: "Callable[[], ImageView]", board: Board
) -> "Feature[PhotoPart]":
    """Declare the pane: a photo is shown with the picture, which ``image`` gives."""

    def make() -> "Pane[PhotoPart]":
        from occ_gui.photo.pane import PhotoPane

        return PhotoPane(scenes, photos, image(), board)

    def part(workspace: Workspace, results: Results) -> "PhotoPart":
        from occ_gui.photo.photo_part import PhotoPart  # with the pane, which asks for it

        return PhotoPart.of(workspace, results)

    return Feature(
        name="photo",
        title="Photo",
        help="photos.md",
        make=make,
        part=part,
        goes_on_hidden=True,
        commands={  # they are enabled once there is a photo
            "match_all": lambda pane: pane.match_all(),
            "find_lamps": lambda pane: pane.parts.find(),
            "region_by_hand": lambda pane: pane.view.lamps.by_hand.toggle(),
            "whole_photo": lambda pane: pane.parts.match_whole(),
            "apply_match": lambda pane: pane.matching.apply(),
            "use_settings": lambda pane: pane.matching.use_notes(),
        },
    )
