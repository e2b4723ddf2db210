"""Measure over a room's floor how many lamps are read, and how accurately the place is found."""

import csv
import math
from collections.abc import Iterable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np

from occ_model.errors import OccError, ParameterError, quote
from occ_model.parallel.job import Heartbeat
from occ_model.results.decoding import Region
from occ_model.results.sweep_csv import csv_row, join_lines, read_count
from occ_model.room.locate import RoomReading, read_room
from occ_model.room.reading import ReadLamp, code_sent
from occ_model.room.render import RoomFrame, render_room
from occ_model.room.room import Room
from occ_model.scene.argument_checks import check_count, check_seed
from occ_model.scene.light_words import has_chips
from occ_model.scene.scene import TOLERANCE
from occ_model.study.sweep.measure import Progress, measure_study
from occ_model.study.sweep.workers import StudyWork
from occ_model.version import __version__

MOST_PLACES = 10_000

_TITLE = "# Lamps read and place found over the floor"
_FORMAT = 2
_START_TIME_SPREAD = 0.1  # seconds over which the start of each picture is drawn at random
_LAMP_MARGIN = 20.0  # pixels around a lamp's rectangle within which a code read is attributed to it


@dataclass(frozen=True, slots=True)
class RoomMapRequest:
    """A map over a floor: the room's camera is moved to each place."""

    room: Room  # The room
    # Places along x and along y, in metres
    across: tuple[float, ...]
    along: tuple[float, ...]
    images: int = 1  # Pictures at each place, each with another start time and noise
    seed: int = 1  # Seed of start times and noise
    tolerance: float = TOLERANCE.default  # As for render_room

    def __post_init__(self) -> None:
        check_seed(self.seed)
        check_count("images", self.images, 1, 10_000)
        check_count("places", self.point_count, 1, MOST_PLACES)
        TOLERANCE.check(self.tolerance)

    @property
    def point_count(self) -> int:
        return len(self.across) * len(self.along)

    def place(self, index: int) -> tuple[float, float]:
        column, row = divmod(index, len(self.along))
        return self.across[column], self.along[row]


@dataclass(frozen=True, slots=True)
class RoomPoint:
    """Results of the pictures at one place."""

    index: int  # The place's number
    # In all pictures together: lamps that are whole, and those of them that were named correctly
    whole: int
    named: int
    # Lamps, whole or cut, whose code was read but is not the one they send
    misread: int
    named_wrongly: int  # Those of them that were named as another lamp of the room
    sure_places: int  # Pictures from which the place was found with certainty
    # Root mean square, over the sure places, of the distance from the true place and of the stated
    # error, in metres; NaN without a sure place
    error: float
    stated_error: float
    note: str  # The first reason why there is no picture or no sure place


@dataclass(frozen=True, slots=True)
class _MeasuredPlaces:
    points: tuple[RoomPoint, ...]
    seconds: float


def places_under(room: Room, count: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return evenly spaced places under a room's lamps, ``count`` per side; 1: their middle."""
    check_count("places on a side", count, 1, MOST_PLACES)
    sides = []
    for places in ([lamp.x for lamp in room.lamps], [lamp.y for lamp in room.lamps]):
        low, high = min(places), max(places)
        ends = np.linspace(low, high, count) if count > 1 else np.array([(low + high) / 2.0])
        sides.append(tuple(float(round(end, 6)) for end in dict.fromkeys(ends.tolist())))
    return sides[0], sides[1]


def measure_place(request: RoomMapRequest, index: int, heartbeat: Heartbeat) -> RoomPoint:
    """Measure one place; a refusal of the model becomes its note."""
    x, y = request.place(index)
    counts = np.zeros(4, dtype=np.int64)
    errors: list[tuple[float, float]] = []
    note = ""
    for number in range(request.images):
        heartbeat()
        random = np.random.default_rng([request.seed, index, number])
        start = request.room.scene.model.start_time + float(random.uniform(0.0, _START_TIME_SPREAD))
        room = request.room.replace(x=x, y=y, start_time=start)
        try:
            frame = render_room(room, tolerance=request.tolerance, seed=int(random.integers(2**31)))
            reading = read_room(frame.camera_image, room)
        except OccError as refusal:
            return RoomPoint(index, 0, 0, 0, 0, 0, math.nan, math.nan, join_lines(str(refusal)))
        counts += _count_lamps(frame, reading)
        if reading.is_sure and reading.located is not None:
            estimate, camera = reading.located.place, room.camera
            difference = (estimate.x - camera.x, estimate.y - camera.y, estimate.z - camera.z)
            errors.append(
                (math.hypot(*difference), float(np.hypot.reduce(reading.located.errors[:3])))
            )
        elif reading.reasons:
            note = note or join_lines(reading.reasons[0])
    error, stated_error = (
        np.sqrt(np.mean(np.square(errors), axis=0)).tolist() if errors else (math.nan, math.nan)
    )
    whole, named, misread, named_wrongly = counts.tolist()
    return RoomPoint(
        index, whole, named, misread, named_wrongly, len(errors), error, stated_error, note
    )


def _count_lamps(frame: RoomFrame, reading: RoomReading) -> tuple[int, int, int, int]:
    """Return the counts of a :class:`RoomPoint`: whole, named, misread and named wrongly."""
    named = misread = named_wrongly = 0
    for read in reading.lamps:
        lamps_at_place = [lamp for lamp in frame.lamps if _is_at(lamp.region, read)]
        codes = [
            code_sent(lamp.lamp) for lamp in lamps_at_place if has_chips(lamp.lamp.transmitter)
        ]
        lamps_named = [lamp for lamp in lamps_at_place if lamp.lamp.name == read.name]
        named += any(not lamp.is_cut for lamp in lamps_named)
        misread += read.code is not None and read.code not in codes
        named_wrongly += read.name is not None and not lamps_named
    return sum(not lamp.is_cut for lamp in frame.lamps), named, misread, named_wrongly


def _is_at(region: Region, read: ReadLamp) -> bool:
    column, row = read.hull.mean(axis=0)
    return bool(
        region.first_column - _LAMP_MARGIN <= column <= region.last_column + _LAMP_MARGIN
        and region.first_row - _LAMP_MARGIN <= row <= region.last_row + _LAMP_MARGIN
    )


def measure_places(
    request: RoomMapRequest, indices: Iterable[int], heartbeat: Heartbeat
) -> _MeasuredPlaces:
    start = perf_counter()
    points = tuple(measure_place(request, index, heartbeat) for index in indices)
    return _MeasuredPlaces(points, perf_counter() - start)


class RoomMapText:
    """The text form of a map's places, one row each."""

    study_name, title, lines_a_point = "map of a room", _TITLE, 1

    def __init__(self, request: RoomMapRequest) -> None:
        self._request = request
        self.point_count = request.point_count
        lines = [
            _TITLE,
            f"# occ_model {__version__}",
            f"# format {_FORMAT} of a room's map",
            f"# seed {request.seed}",
            f"# images {request.images}, at every place",
            f"# tolerance {request.tolerance!r} levels",
            *(f"# {name} (m): {', '.join(map(repr, places))}"
              for name, places in (("x", request.across), ("y", request.along))),
            "#",
            "# room of this file:",
            *(f"# {line}".rstrip() for line in request.room.to_toml().splitlines()),
        ]  # fmt: skip
        columns = (
            "x (m)", "y (m)", "images", "whole lamps", "named correctly", "misread",
            "named wrongly", "sure places", "error (m)", "stated error (m)", "note",
        )  # fmt: skip
        self.header = "\n".join(lines) + "\n" + csv_row(columns)

    def text(self, point: RoomPoint) -> str:
        return csv_row((
            *self._request.place(point.index), self._request.images, point.whole, point.named,
            point.misread, point.named_wrongly, point.sure_places, point.error,
            point.stated_error, point.note,
        ))  # fmt: skip

    def read(self, lines: Sequence[str], number: int) -> RoomPoint | None:
        """Parse a place; the caller checks it by writing it again.

        Returns None if it is no row of this map. Raises ParameterError if a count or an error in
        this line is impossible.
        """
        try:
            (line,) = lines
            x, y, _, *counts, error, stated, note = next(csv.reader([line], strict=True))
            across = [repr(place) for place in self._request.across].index(x)
            along = [repr(place) for place in self._request.along].index(y)
            whole_text, named, misread, named_wrongly, sure_places = counts
        except (ValueError, StopIteration, csv.Error):
            return None
        images, camera = self._request.images, self._request.room.scene.camera
        lamps = images * len(self._request.room.lamps)
        pixels = images * camera.rows * camera.columns  # no picture shows more lamps than pixels
        whole = read_count("whole lamps", whole_text, 0, lamps, number)
        places = read_count("sure places", sure_places, 0, images, number)
        return RoomPoint(
            across * len(self._request.along) + along,
            whole,
            read_count("named correctly", named, 0, whole, number),
            read_count("misread", misread, 0, pixels, number),
            read_count("named wrongly", named_wrongly, 0, lamps, number),
            places,
            _read_distance("error (m)", error, bool(places), number),
            _read_distance("stated error (m)", stated, bool(places), number),
            note,
        )


def _read_distance(name: str, text: str, is_known: bool, line: int) -> float:
    """Parse a distance in metres; NaN if none is known."""
    try:
        distance = float(text) if text else math.nan
    except ValueError:
        distance = -1.0
    if math.isnan(distance) if not is_known else 0.0 <= distance < math.inf:
        return distance
    allowed = "numbers from 0 m" if is_known else "nothing, without a sure place"
    raise ParameterError.of(name, quote(text), allowed).within(f"line {line}")


def room_map(
    request: RoomMapRequest,
    *,
    executor: Executor | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
    results: str | Path | None = None,
) -> tuple[RoomPoint, ...]:
    """Measure the places of a map in order; arguments and errors as for :func:`occ_model.sweep`."""
    points: list[RoomPoint] = []
    text = RoomMapText(request)

    def sort_points() -> list[RoomPoint]:
        return sorted(points, key=lambda point: point.index)

    measure_study(
        StudyWork("map", measure_places, lambda indices: (request, tuple(indices))), text,
        range(request.point_count), points.append,
        lambda: [text.header, *map(text.text, sort_points())],
        executor=executor, jobs=jobs, progress=progress, results=results,
    )  # fmt: skip
    return tuple(sort_points())
