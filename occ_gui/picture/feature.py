"""The pane of the whole picture, declared."""

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.shell.feature import Draw, Feature, Figure, NothingToDraw, Pane
from occ_gui.shell.results import Results
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.photo_choice import MODES, Placement

if TYPE_CHECKING:
    from occ_gui.picture.image_view import ImageView, PicturePart, PicturesPane
    from occ_model.figures.drawing import Drawing
    from occ_model.photo.reading.load import Photo


def picture(store: Store, about_photo: Callable[[], str]) -> "Feature[PicturePart]":
    """Declare the pane, which stands in the story in place of its rows.

    ``about_photo`` gives what stands under a figure with the photo.
    """

    def make() -> "Pane[PicturePart]":
        from occ_gui.picture.image_view import PicturesPane

        return PicturesPane(store)

    def part(workspace: Workspace, results: Results) -> "PicturePart":
        there = (results.picture, results.snapshot, results.reading, results.before)
        return (*there, workspace.whose, workspace.overlay)

    return Feature(
        name="picture",
        title="Picture",
        help="guide.md#look-at-the-picture",
        make=make,
        part=part,
        goes_on_hidden=True,
        figures=picture_figures(store, about_photo),
    )


_BESIDE, _BLENDED, _SPLIT, _DIFFERENCE = MODES

_OVERLAY_FILE = "picture-with-photo"


def picture_figures(store: Store, about_photo: Callable[[], str]) -> tuple[Figure, Figure]:
    """Declare the figures; ``about_photo`` gives what stands under a picture of the photo."""

    def picture(pane: "PicturesPane | None", shown: Snapshot) -> Draw:
        workspace = store.workspace
        photo = _photo(pane)
        if pane is None or photo is None:
            return _alone(shown, workspace.whose)
        return _with_photo(pane.view, photo, shown, workspace.overlay, about_photo())

    def overlay(pane: "PicturesPane | None", shown: Snapshot) -> Draw:
        photo = _photo(pane)
        if pane is None or photo is None:
            raise NothingToDraw("No photo is open: open one to lay it over the picture.")
        mode = store.workspace.overlay
        laid = _BLENDED if mode == _BESIDE else mode
        over = _with_photo(pane.view, photo, shown, laid, about_photo())
        return lambda: replace(over(), name=_OVERLAY_FILE)

    def is_beside(pane: "PicturesPane | None") -> bool:
        return _photo(pane) is not None and store.workspace.overlay == _BESIDE

    title = "Overlay of photo and picture"
    return (
        Figure(name="picture", title="Picture", draw=picture),
        Figure(name="overlay", title=title, draw=overlay, is_another=is_beside),
    )


def _photo(pane: "PicturesPane | None") -> "Photo | None":
    return None if pane is None else pane.view.shown_photo


def _alone(shown: Snapshot, whose: str) -> Draw:
    def draw() -> "Drawing":
        from occ_model.figures.window_panes import picture_drawing

        return picture_drawing(shown.frame, shown.decoded.region, None, whose, None, "")

    return draw


def _with_photo(view: "ImageView", opened: "Photo", shown: Snapshot, mode: str, about: str) -> Draw:
    frame, region = shown.frame, shown.decoded.region
    photo, whose, over = opened.image, view.whose, view.overlay
    place = over.placement
    opacities = {_BLENDED: (over.opacity, None), _SPLIT: (1.0, over.split_row)}
    laid, times = opacities.get(mode), over.times

    def draw() -> "Drawing":
        from occ_gui.picture.photo_overlay import difference_cells, rect_of
        from occ_model.figures.overlay import Difference, PhotoLayer
        from occ_model.figures.window_panes import MOST_CELLS, picture_drawing

        layer: PhotoLayer | Difference | None = None
        if laid is not None:
            layer = PhotoLayer(place.column, place.row, place.scale, *laid)
        elif mode == _DIFFERENCE:
            image = frame.picture(whose)
            layers = (image, rect_of(image, Placement())), (photo, rect_of(photo, place))
            found = difference_cells(*layers, MOST_CELLS)
            if found is None:
                raise NothingToDraw("Photo and simulation do not overlap: there is no difference.")
            levels, grid = found
            edges = (grid.left(), grid.right(), grid.bottom(), grid.top())
            layer = Difference(levels, edges, times)
        return picture_drawing(frame, region, photo, whose, layer, about)

    return draw
