"""Figures: the panes that can be exported, with the data that they show at the moment."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from PySide6.QtCore import QObject

from occ_gui.detection_map.map_controller import MapRequest
from occ_gui.detection_map.rate_map import RateMap
from occ_gui.detection_map.sweep_table import table_of
from occ_gui.export.jobs import FigureRequest
from occ_gui.picture.placement import Placement
from occ_gui.scene.frame_rate import FrameRate
from occ_gui.scene.settings_store import SettingsStore
from occ_gui.simulation.snapshot import Snapshot
from occ_model.errors import OccError
from occ_model.photo.reading.load import Photo
from occ_model.results.accuracy import AccuracyPoint
from occ_model.results.bench import BenchPoint, BenchRequest
from occ_model.results.decoding import DecodeResult
from occ_model.results.frame import PICTURES
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing


class NothingToDraw(OccError):  # noqa: N818 - not an error: the data are not complete yet
    """There are no data yet for a figure."""


class Panes(Protocol):
    """Gives panes by their names."""

    def pane(self, name: str) -> Any:
        """Give a pane, which is made if it has never been seen."""

    def made_pane(self, name: str) -> Any:
        """Give a pane, None if it has never been seen."""


OVERLAY = "overlay"
"""The figure of the photo over the picture."""

_OVERLAY_FILE = "picture-with-photo"

_BESIDE, _BLENDED = "beside", "blend"
"""How the photo is shown beside the picture, and over it."""

FullBench = tuple[BenchRequest, tuple[BenchPoint, ...]]
"""What a bench has measured."""


@dataclass(frozen=True, eq=False, slots=True)
class BenchFigureRequest(FigureRequest):
    """A figure of a bench, which has settings of its own.

    Parameters
    ----------
    frames_a_second
        Pictures a second.
    """

    measured: BenchRequest
    frames_a_second: float

    def provenance(self, drawing: "Drawing") -> Provenance:  # noqa: ARG002 - it says its own title
        """Say how the points were measured."""
        from occ_model.figures.bench import bench_provenance

        return bench_provenance(self.measured, self.frames_a_second, self.date)


class Overlay(Protocol):
    """The photo over the simulated picture."""

    @property
    def mode(self) -> str:
        """How the photo is shown; ``"blend"`` and ``"split"`` lay it over the picture."""

    @property
    def placement(self) -> Placement:
        """Where the photo lies."""

    @property
    def opacity(self) -> float:
        """The opacity of a blended photo, from 0 to 1."""

    @property
    def split_row(self) -> float:
        """The row from which downwards the photo is seen where the picture is split."""

    @property
    def times(self) -> int:
        """The factor by which the difference is drawn."""


Source = Callable[[Snapshot], FigureRequest]
"""Returns the request for a figure of some results, or raises NothingToDraw."""


class Figures(QObject):
    """The sources of all figures, by the figures' names.

    Parameters
    ----------
    panes
        Gives the panes that determine the content of their figures.
    """

    def __init__(
        self,
        settings: SettingsStore,
        panes: Panes,
        decoders: tuple[str, ...],
        *,
        shown_decoder: Callable[[], str],
    ) -> None:
        super().__init__()
        self._settings, self._shown_decoder = settings, shown_decoder
        self._panes = panes
        self._photo: Photo | None = None
        self._whose = PICTURES[0]
        self._sources: dict[str, Source] = {
            "picture": self._of_picture,
            OVERLAY: self._of_overlay,
            "profile": self._of_profile,
        }
        self.titles = {
            "picture": "Picture",
            OVERLAY: "Overlay of photo and picture",
            "profile": "Column profile",
        }
        for decoder in decoders:
            name = f"decoding-{decoder}"
            title = f"Decoding, {decoder}"
            self.add(name, title, partial(self._of_decoding, decoder))
        self.add("accuracy", "Accuracy and time", self._of_accuracy)

    def add_map(
        self, full: Callable[[], tuple[RateMap, MapRequest] | None], frame_rate: FrameRate
    ) -> None:
        """Add the figure of the detection map, which is available once all its points are known."""
        self.add("map", "Detection map", partial(self._of_map, full, frame_rate))

    def _of_map(
        self,
        full: Callable[[], tuple[RateMap, MapRequest] | None],
        frame_rate: FrameRate,
        shown: Snapshot,
    ) -> FigureRequest:
        there = full()
        if there is None:
            raise NothingToDraw(
                "The detection map is not complete yet: open its pane and wait a moment."
            )
        table, what = table_of(*there, frame_rate.value), frame_rate.shown

        def draw() -> "Drawing":
            from occ_model.figures.sweep import sweep_drawing

            return sweep_drawing(table, what)

        return self.request(shown.frame.scene, draw)

    def add_bench(self, full: Callable[[], FullBench | None], frame_rate: FrameRate) -> None:
        """Add the figure of the bench, which is available once all its points are known."""
        self.add("bench", "Bench", partial(self._of_bench, full, frame_rate))

    def _of_bench(
        self, full: Callable[[], FullBench | None], frame_rate: FrameRate, shown: Snapshot
    ) -> FigureRequest:
        there = full()
        if there is None:
            raise NothingToDraw(
                "The bench is not complete: open its pane, measure and wait a moment."
            )
        (measured, points), rate = there, frame_rate.value

        def draw() -> "Drawing":
            from occ_model.figures.bench import bench_drawing

            return bench_drawing(measured, points, rate)

        request = self.request(shown.frame.scene, draw)
        return BenchFigureRequest(
            request.scene, request.settings, request.date, draw, measured, rate
        )

    def add(self, name: str, title: str, source: Source) -> None:
        self._sources[name] = source
        self.titles[name] = title

    @property
    def sources(self) -> Mapping[str, Source]:
        return self._sources

    @property
    def shown(self) -> Mapping[str, Source]:
        """The sources of the figures that differ from each other at the moment."""
        is_overlay = self._photo is not None and self._overlay().mode == _BESIDE
        return {n: source for n, source in self._sources.items() if n != OVERLAY or is_overlay}

    def _overlay(self) -> Overlay:
        overlay: Overlay = self._panes.pane("picture").view.overlay
        return overlay

    def _about_photo(self) -> str:
        """Tell of the photo what stands under pictures and profiles of it."""
        photo = self._panes.made_pane("photo")
        return "" if photo is None else str(photo.verdict.about())

    def choose_picture(self, whose: str) -> None:
        """Draw the picture of the camera or of the receiver from now on."""
        self._whose = whose

    def show_photo(self, photo: Photo | None) -> None:
        """Draw this photo beside the picture from now on, or none."""
        self._photo = photo

    def request(self, scene: Scene, draw: "Callable[[], Drawing]") -> FigureRequest:
        """Create the request for a figure, with the settings and the time of now."""
        now = datetime.now().astimezone().isoformat(timespec="seconds")
        return FigureRequest(scene, self._settings.settings, now, draw)

    def _of_overlay(self, shown: Snapshot) -> FigureRequest:
        """Request the photo over the picture, blended unless it is shown over it another way."""
        if self._photo is None:
            raise NothingToDraw("No photo is open: open one to lay it over the picture.")
        mode = self._overlay().mode
        request = self._picture_request(shown, _BLENDED if mode == _BESIDE else mode)
        draw = request.draw
        return replace(request, draw=lambda: replace(draw(), name=_OVERLAY_FILE))

    def _of_picture(self, shown: Snapshot) -> FigureRequest:
        return self._picture_request(shown, self._overlay().mode)

    def _picture_request(self, shown: Snapshot, mode: str) -> FigureRequest:
        """Request the picture with the photo, if there is one, beside or over it."""
        photo = None if self._photo is None else self._photo.image
        frame, region, whose = shown.frame, shown.decoded.region, self._whose
        over = self._overlay()
        place = over.placement
        opacities = {"blend": (over.opacity, None), "split": (1.0, over.split_row)}
        laid, times = opacities.get(mode), over.times
        compared = photo if mode == "difference" else None
        about = "" if photo is None else self._about_photo()

        def draw() -> "Drawing":
            from occ_gui.picture.difference_image import difference_cells
            from occ_gui.picture.photo_overlay import rect_of
            from occ_model.figures.overlay import Difference, PhotoLayer
            from occ_model.figures.window_panes import MOST_CELLS, picture_drawing

            layer: PhotoLayer | Difference | None = None
            if laid is not None:
                layer = PhotoLayer(place.column, place.row, place.scale, *laid)
            elif compared is not None:
                image = frame.picture(whose)
                layers = (image, rect_of(image, Placement())), (compared, rect_of(compared, place))
                found = difference_cells(*layers, MOST_CELLS)
                if found is None:
                    raise NothingToDraw(
                        "Photo and simulation do not overlap: there is no difference."
                    )
                levels, grid = found
                edges = (grid.left(), grid.right(), grid.bottom(), grid.top())
                layer = Difference(levels, edges, times)
            return picture_drawing(frame, region, photo, whose, layer, about)

        return self.request(frame.scene, draw)

    def _of_profile(self, shown: Snapshot) -> FigureRequest:
        photo, profile = self._panes.made_pane("photo"), self._panes.pane("profile").view
        comparison = None if photo is None else photo.comparison.comparison()
        about = "" if comparison is None else self._about_photo()
        columns = slice(*profile.columns_in_view())
        enhanced = profile.is_enhanced
        band = shown.enhanced_band if enhanced else shown.band
        decoded = _read_by(self._shown_decoder(), shown)

        def draw() -> "Drawing":
            from occ_model.figures.window_panes import profile_drawing

            return profile_drawing(
                shown.frame, band, shown.band_undefined, comparison, columns,
                enhanced=enhanced, decoded=decoded, about=about,
            )  # fmt: skip

        return self.request(shown.frame.scene, draw)

    def _of_decoding(self, decoder: str, shown: Snapshot) -> FigureRequest:
        result = _read_by(decoder, shown)
        if result is None:
            raise NothingToDraw(f"The {decoder} decoder has not read the picture.")

        def draw() -> "Drawing":
            from occ_model.figures.decoding import decode_drawing

            return decode_drawing(shown.frame.scene, result)

        return self.request(shown.frame.scene, draw)

    def _of_accuracy(self, shown: Snapshot) -> FigureRequest:
        pane = self._panes.made_pane("accuracy")
        points: tuple[AccuracyPoint, ...] = () if pane is None else pane.view.plot.measured
        if not points:
            raise NothingToDraw(
                "What accuracy costs is not measured yet: open its pane and wait a moment."
            )

        def draw() -> "Drawing":
            from occ_model.figures.accuracy import accuracy_drawing

            return accuracy_drawing(points)

        return self.request(shown.frame.scene, draw)


def _read_by(decoder: str, shown: Snapshot) -> DecodeResult | None:
    results = (shown.decoded, *shown.others)
    return next((result for result in results if result.decoder == decoder), None)
