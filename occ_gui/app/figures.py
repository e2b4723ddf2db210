"""Declarations of the panes' figures."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from occ_gui.core.store import Store
from occ_gui.shell.feature import Draw, Figure, NothingToDraw, defer
from occ_gui.shell.results import ResultsStore
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.simulation.verdict import cause_in
from occ_gui.values.choices import OVERLAYS, Placement
from occ_model.receiver.decode import QUICK_DECODERS

if TYPE_CHECKING:
    from occ_gui.accuracy.pane import AccuracyPane
    from occ_gui.bench.pane import BenchPane
    from occ_gui.detection_map.pane import MapPane
    from occ_gui.picture.image_view import ImageView, PicturesPane
    from occ_gui.profile.pane import ProfilePane
    from occ_gui.room.pane import RoomPane
    from occ_model.figures.drawing import Drawing
    from occ_model.photo.reading.load import Photo

_BESIDE, _BLENDED, _SPLIT, _DIFFERENCE = OVERLAYS

_OVERLAY_FILE = "picture-with-photo"


def picture_figures(store: Store, describe_photo: Callable[[], str]) -> tuple[Figure, Figure]:
    """Declare both figures; ``describe_photo`` returns the caption of a picture with the photo."""

    def draw_picture(pane: "PicturesPane | None", snapshot: Snapshot) -> Draw:
        workspace, photo = store.workspace, _find_photo(pane)
        if pane is None or photo is None:
            return defer(
                "occ_model.figures.window_panes:picture_drawing",
                snapshot.frame, snapshot.region, None, workspace.picture_kind, None, "",
            )  # fmt: skip
        return _lay_over(pane.view, photo, snapshot, workspace.overlay, describe_photo())

    def draw_overlay(pane: "PicturesPane | None", snapshot: Snapshot) -> Draw:
        photo = _find_photo(pane)
        if pane is None or photo is None:
            raise NothingToDraw("No photo is open: open one to lay it over the picture.")
        mode = store.workspace.overlay
        mode = _BLENDED if mode == _BESIDE else mode
        draw = _lay_over(pane.view, photo, snapshot, mode, describe_photo())
        return lambda: replace(draw(), name=_OVERLAY_FILE)

    def is_beside(pane: "PicturesPane | None") -> bool:
        return _find_photo(pane) is not None and store.workspace.overlay == _BESIDE

    title = "Overlay of photo and picture"
    return (
        Figure(name="picture", title="Picture", draw=draw_picture),
        Figure(name="overlay", title=title, draw=draw_overlay, differs_from_others=is_beside),
    )


def _find_photo(pane: "PicturesPane | None") -> "Photo | None":
    return None if pane is None else pane.view.shown_photo


def _lay_over(
    view: "ImageView", photo: "Photo", snapshot: Snapshot, mode: str, caption: str
) -> Draw:
    frame, region = snapshot.frame, snapshot.region
    pixels, picture_kind, overlay = photo.image, view.picture_kind, view.overlay
    place = overlay.placement
    opacities = {_BLENDED: (overlay.opacity, None), _SPLIT: (1.0, overlay.split_row)}
    opacity, gain = opacities.get(mode), overlay.difference.gain

    def draw() -> "Drawing":
        from occ_gui.picture.photo_overlay import difference_cells, rect_of
        from occ_model.figures.window_panes import (
            MOST_CELLS,
            Difference,
            PhotoLayer,
            picture_drawing,
        )

        layer: PhotoLayer | Difference | None = None
        if opacity is not None:
            layer = PhotoLayer(place.column, place.row, place.scale, *opacity)
        elif mode == _DIFFERENCE:
            image = frame.picture(picture_kind)
            layers = (image, rect_of(image, Placement())), (pixels, rect_of(pixels, place))
            cells = difference_cells(*layers, MOST_CELLS)
            if cells is None:
                raise NothingToDraw("Photo and simulation do not overlap: there is no difference.")
            levels, grid = cells
            edges = (grid.left(), grid.right(), grid.bottom(), grid.top())
            layer = Difference(levels, edges, gain)
        return picture_drawing(frame, region, pixels, picture_kind, layer, caption)

    return draw


def profile_figure(
    store: Store, results_store: ResultsStore, describe_photo: Callable[[], str]
) -> Figure:
    def draw(pane: "ProfilePane | None", snapshot: Snapshot) -> Draw:
        workspace, photo = store.workspace, results_store.results.photo_profile
        comparison = None if photo is None else photo.comparison
        all_columns, enhanced = (0, len(snapshot.profile)), workspace.is_enhanced
        return defer(
            "occ_model.figures.window_panes:profile_drawing",
            snapshot.frame,
            snapshot.band_levels(enhanced=enhanced),
            snapshot.band_undefined,
            comparison,
            slice(*(all_columns if pane is None else pane.view.columns_in_view())),
            enhanced=enhanced,
            decoded=snapshot.results.get(workspace.decoder),
            about="" if comparison is None else describe_photo(),
        )

    return Figure(name="profile", title="Column profile", draw=draw)


def decoding_figures() -> tuple[Figure, ...]:
    return tuple(
        Figure(name=f"decoding-{name}", title=f"Decoding, {name}", draw=partial(_draw_steps, name))
        for name in QUICK_DECODERS
    )


def _draw_steps(decoder: str, _pane: object, snapshot: Snapshot) -> Draw:
    result = snapshot.results.get(decoder)
    if result is None:
        raise NothingToDraw(f"The {decoder} decoder has not read the picture.")
    cause = cause_in(snapshot, result)
    return defer("occ_model.figures.decoding:decode_drawing", snapshot.frame.scene, result, cause)


def accuracy_figure() -> Figure:
    def draw(pane: "AccuracyPane | None", _snapshot: Snapshot) -> Draw:
        points = () if pane is None else pane.view.plot.study_points
        if not points:
            raise NothingToDraw(
                "The cost of accuracy is not measured yet: open its pane and wait a moment."
            )
        return defer("occ_model.figures.accuracy:accuracy_drawing", points)

    return Figure(name="accuracy", title="Accuracy and time", draw=draw)


def map_figure(store: Store) -> Figure:
    def draw(pane: "MapPane | None", _snapshot: Snapshot) -> Draw:
        complete = None if pane is None else pane.map.complete
        if complete is None:
            raise NothingToDraw(
                "The detection map is not complete yet: open its pane and wait a moment."
            )
        from occ_gui.detection_map.map_schedule import make_table

        table = make_table(*complete, store.workspace.frame_rate)
        return defer("occ_model.figures.sweep:sweep_drawing", table, store.workspace.shown)

    return Figure(name="map", title="Detection map", draw=draw)


def bench_figure(store: Store) -> Figure:
    def draw(pane: "BenchPane | None", _snapshot: Snapshot) -> Draw:
        complete = None if pane is None else pane.controller.complete
        if complete is None:
            raise NothingToDraw(
                "The bench is not complete: open its pane, measure and wait a moment."
            )
        rate = store.workspace.frame_rate
        return defer("occ_model.figures.bench:bench_drawing", *complete, rate)

    return Figure(name="bench", title="Bench", draw=draw)


def bands_figures() -> tuple[Figure, ...]:
    def draw(name: str) -> Callable[[Any, Snapshot], Draw]:
        return lambda _, snapshot: defer(f"occ_model.figures.bands:{name}", snapshot.frame.scene)

    return (
        Figure(name="bands", title="Bars", draw=draw("bands_drawing")),
        Figure(name="flicker", title="Flicker for the eye", draw=draw("flicker_drawing")),
    )


def room_figure() -> Figure:
    """Declare the figure, which is available once the picture from the present place is read."""

    def draw(pane: "RoomPane | None", _snapshot: Snapshot) -> Draw:
        part = None if pane is None else pane.picture
        if part is None or part.reading is None:
            raise NothingToDraw(
                "The room's picture is not read yet: open its pane and wait a moment."
            )
        return defer(
            "occ_model.figures.room:room_drawing",
            part.room, part.image, part.reading, is_photo=part.source.photo is not None,
        )  # fmt: skip

    return Figure(name="room", title="Room", draw=draw)
