"""Compare code lengths for many lamps: number of codes, their distance, and what is read.

A longer code leaves most of its words unused, so a misread code is rarely that of another lamp, but
a picture shows fewer of its longer packets. A room has at most 200 lamps; the other lamps of a
larger building take codes but are not simulated.
"""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from occ_model.arrays import ByteArray, IndexArray
from occ_model.errors import ParameterError, ProjectionError, inflect
from occ_model.results.sweep_request import MOST_JOBS
from occ_model.room.room import Room
from occ_model.room.view import lamps_in_view
from occ_model.scene.argument_checks import check_count
from occ_model.study.room_map import RoomMapRequest, room_map
from occ_model.study.sweep.sweep import Progress
from occ_model.transmitter.scheme import check_code, sent_chips

MOST_CODES = 4096  # maximum number of lamps, whose codes are compared in pairs
_EXTRA_BITS = (0, 2, 4)  # bits beyond the minimum that gives each lamp its own code


@dataclass(frozen=True, slots=True)
class CodeLength:
    """Result for one code length."""

    # Bits of a code, and chips of its packet
    bits: int
    chips: int
    columns: float  # Columns that one packet takes in a picture
    packets: float  # Median number of packets of a lamp that is whole in the picture
    # Minimum number of chips in which two lamps' packets differ, at any shift between them
    distance: int
    # Numbers of lamps that are whole in the pictures, of those named correctly, and of codes
    # misread
    whole: int
    named: int
    misread: int

    @property
    def codes(self) -> int:
        return 1 << self.bits

    def expected_mix_ups(self, lamps: int) -> float:
        """Return the expected number of lamps misread as another, if misread codes are uniform."""
        return self.misread * (lamps - 1) / (self.codes - 1)


def code_lengths(
    request: RoomMapRequest,
    lamps: int = 1024,
    bits: Sequence[int] = (),
    *,
    executor: Executor | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
) -> tuple[CodeLength, ...]:
    """Compare code lengths, by default the shortest for this many lamps, and 2 and 4 bits more.

    The codes of all lamps, including the room's, are drawn at random from those of a length. The
    lamps of the room are read in pictures taken over its floor. A packet's chips, columns and
    distance are those of the first lamp's line code and framing. Raises ParameterError if a length
    has fewer codes than there are lamps, or an argument is out of range.
    """
    room = request.room
    check_count("lamps", lamps, max(len(room.lamps), 2), MOST_CODES)
    check_count("jobs", jobs, 1, MOST_JOBS)
    for lamp in room.lamps:
        check_code(lamp.transmitter, "map the room, whose lamps are named by their frequency")
    lengths = tuple(bits) or tuple((lamps - 1).bit_length() + more for more in _EXTRA_BITS)
    for length in lengths:
        if 2**length < lamps:
            raise ParameterError.of("bits", f"{length}", f"from {(lamps - 1).bit_length()}",
                                    condition=f"for {inflect(lamps, 'lamp')}")  # fmt: skip
    results, median_columns = [], _median_columns(request)
    for number, length in enumerate(lengths):
        codes = _draw_codes(length, lamps, request.seed)
        coded_room = _send_codes(room, length, codes)
        map_request = replace(request, room=coded_room)
        report = progress and partial(report_progress, progress, number, len(lengths))
        points = room_map(map_request, executor=executor, jobs=jobs, progress=report)
        whole, named, misread = (
            sum(getattr(point, count) for point in points)
            for count in ("whole", "named", "misread")
        )
        packets = _list_packets(coded_room, codes)
        transmitter = coded_room.lamps[0].transmitter
        readout_time = room.scene.camera.readout_time
        columns = packets.shape[1] / transmitter.switching_frequency / readout_time
        results.append(CodeLength(
            length, packets.shape[1], columns, median_columns / columns,
            least_distance(packets), whole, named, misread,
        ))  # fmt: skip
    return tuple(results)


def report_progress(
    progress: Progress, number: int, lengths: int, done: int, points: int, seconds_left: float
) -> None:
    all_done, total = number * points + done, lengths * points
    progress(all_done, total, seconds_left * (total - all_done) / max(points - done, 1))


def _draw_codes(bits: int, lamps: int, seed: int) -> IndexArray:
    random = np.random.default_rng([seed, bits])
    return random.choice(2**bits, lamps, replace=False).astype(np.int64)


def _send_codes(room: Room, bits: int, codes: IndexArray) -> Room:
    """Return the room with its lamps sending the first of the codes, without payload or pattern."""
    settings: dict[str, int | str] = {"bits": bits, "payload": "", "pattern": ""}
    lamps = tuple(
        replace(lamp, transmitter=lamp.transmitter.replaced({**settings, "code": int(code)}))
        for lamp, code in zip(room.lamps, codes, strict=False)
    )
    return room.replace(lamps=lamps, code=0, bits=bits)


def _list_packets(room: Room, codes: IndexArray) -> ByteArray:
    """Return the packets of the codes, shape (codes, chips)."""
    transmitter = room.lamps[0].transmitter
    return np.array([sent_chips(transmitter.replaced({"code": int(code)})) for code in codes])


def least_distance(packets: ByteArray) -> int:
    """Return the minimum number of chips in which two packets, shape (packets, chips), differ."""
    signs, chips = 2.0 * packets - 1.0, int(packets.shape[1])
    largest = -float(chips)
    for shift in range(chips):
        correlations = signs @ np.roll(signs, shift, axis=1).T
        np.fill_diagonal(correlations, largest)
        largest = max(largest, float(correlations.max()))
    return round((chips - largest) / 2.0)


def _median_columns(request: RoomMapRequest) -> float:
    """Return the median number of columns of a whole lamp over all places; 0 without any."""
    camera = request.room.scene.camera
    columns = []
    for index in range(request.point_count):
        x, y = request.place(index)
        try:
            in_view = lamps_in_view(request.room.replace(x=x, y=y))
        except ProjectionError:  # no picture is taken there
            continue
        for lamp in in_view:
            low, high = lamp.view.corners.min(axis=0), lamp.view.corners.max(axis=0)
            if low.min() >= 0 and high[0] < camera.columns and high[1] < camera.rows:
                columns.append(float(high[0] - low[0]))
    return float(np.median(columns)) if columns else 0.0
