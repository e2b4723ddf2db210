"""What a board sends for a scene: the chips, how long each lasts, and visible flicker.

A chip's length is rounded to whole cycles of the clock, and the error is stated exactly. Spreading
the fraction over the chips would keep the mean frequency but move single edges by up to half a
cycle, which cannot be corrected in a photo, whereas the exact frequency can be put into the scene.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import floor

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.boards.board import TransmitterBoard
from occ_model.errors import ParameterError
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND
from occ_model.transmitter.line_codes.line_code import VISIBLE_LIMIT
from occ_model.transmitter.scheme import packet, shortest_period


@dataclass(frozen=True, slots=True)
class BoardTiming:
    clock: int  # Frequency of the board's clock in Hz
    prescaler: int
    count: int  # Divided cycles for a chip
    asked: Fraction  # The requested switching frequency, in Hz

    @property
    def cycles(self) -> int:
        return self.prescaler * self.count

    @property
    def frequency(self) -> Fraction:
        """The switching frequency that is sent, in Hz."""
        return Fraction(self.clock, self.cycles)

    @property
    def period(self) -> Fraction:
        return Fraction(self.cycles, self.clock)

    @property
    def error_ppm(self) -> Fraction:
        """Relative error of the frequency in parts per million, positive if it is too high."""
        return (self.frequency / self.asked - 1) * 10**6

    @property
    def is_as_asked(self) -> bool:
        """Whether the frequency is the requested one to the precision of a scene's numbers."""
        return float(self.frequency) == float(self.asked)


def choose_timing(board: TransmitterBoard, frequency: float) -> BoardTiming:
    """Choose the timer's setting with the nearest frequency; among equals the finest timer."""
    asked = Fraction(frequency)
    if not board.lowest_frequency <= asked <= board.highest_frequency:
        raise _refuse_frequency(board, frequency)
    settings = (
        BoardTiming(board.clock, prescaler, count, asked)
        for prescaler in board.prescalers
        for count in _list_counts(board, prescaler, asked)
    )
    return min(settings, key=lambda timing: (abs(timing.error_ppm), timing.prescaler))


def _list_counts(board: TransmitterBoard, prescaler: int, asked: Fraction) -> Iterator[int]:
    """Yield the whole numbers next to the exact count, as far as the board allows them."""
    below = floor(board.clock / (prescaler * asked))
    for count in (below, below + 1):
        if 1 <= count <= board.largest_count and prescaler * count >= board.least_cycles:
            yield count


def _refuse_frequency(board: TransmitterBoard, frequency: float) -> ParameterError:
    declared = quantity("switching_frequency")
    low, high = float(board.lowest_frequency), float(board.highest_frequency)
    why = board.limit_reason if frequency > high else "the timer cannot count longer"
    return ParameterError.of(
        declared.name,
        declared.format(frequency),
        f"{declared.format(low)} to {declared.format(high)}, since {why}",
        condition=f"on {board.title}",
        parameters=(declared.name,),
    )


@dataclass(frozen=True, eq=False)
class Transmission:
    """One period of the chips that a board repeats, and their length."""

    scene: Scene
    board: TransmitterBoard
    chips: ByteArray  # Shape (chips,): one period in the order sent; 1 is lit
    timing: BoardTiming

    @property
    def sent_scene(self) -> Scene:
        """The scene with the switching frequency that is actually sent."""
        return self.scene.replace(switching_frequency=float(self.timing.frequency))

    @cached_property
    def edges(self) -> tuple[int, ...]:
        """Indices of the chips that differ from the chip before, in the repeated period."""
        return tuple(np.flatnonzero(self.chips != np.roll(self.chips, 1)).tolist())

    @property
    def longest_run(self) -> Fraction | None:
        """Longest time in s without an edge in the repeated period; None if there are no edges."""
        if not self.edges:
            return None
        following = (*self.edges[1:], self.edges[0] + len(self.chips))
        runs = (end - start for start, end in zip(self.edges, following, strict=True))
        return max(runs) * self.timing.period

    @property
    def lowest_frequency(self) -> Fraction | None:
        """Lowest frequency in Hz that the light contains; None if it never changes."""
        if not self.edges:
            return None
        return self.timing.frequency / shortest_period(self.chips)

    @property
    def is_visible(self) -> bool:
        """Whether the light contains frequencies that people may see as flicker."""
        return self.lowest_frequency is not None and self.lowest_frequency < VISIBLE_LIMIT


def prepare_transmission(scene: Scene, board: TransmitterBoard) -> Transmission:
    """Prepare what a board sends; ParameterError if it cannot send at that frequency or so much."""
    chips = packet(scene)
    room = count_table_bytes(board, len(chips))
    if room > board.table_bytes:
        raise ParameterError(
            f"The packet has {len(chips):,} chips, which take {room:,} bytes on {board.title}; "
            f"allowed: {board.table_bytes:,} bytes. Send fewer bits.",
            parameters=("payload", "line_code", "framing"),
        )
    return Transmission(
        scene, board, chips, choose_timing(board, scene.transmitter.switching_frequency)
    )


def count_table_bytes(board: TransmitterBoard, chips: int) -> int:
    """Count the bytes of a packet on a board; MicroPython's is unpacked into words of 32 chips."""
    if board.language == "MicroPython":
        return chips * count_repeats(chips) // 8
    return -(-chips // 8)


def count_repeats(chips: int) -> int:
    """Count the repetitions of a period that fill whole words of 32 chips."""
    return next(times for times in (1, 2, 4, 8, 16, 32) if chips * times % 32 == 0)


EYES = (
    "Do not look into a bright LED or panel at close range, nor let others do so; turn it off when "
    "nobody is photographing it."
)

SEIZURES = (
    "Flicker of 3 to 70 Hz can cause seizures in people with photosensitive epilepsy "
    "(IEEE 1789-2015)."
)


def flicker_sentence(sent: Transmission) -> str:
    """State the lowest frequency in the light, and whether it is visible."""
    lowest, run = sent.lowest_frequency, sent.longest_run
    if lowest is None or run is None:
        return "The light does not change: all chips are equal."
    limit = HERTZ.format(VISIBLE_LIMIT)
    said = (
        f"The lowest frequency in the light is {HERTZ.format(float(lowest), 4)}, at which the "
        f"packet repeats; its longest time without an edge is {SECOND.format(float(run), 4)}."
    )
    if sent.is_visible:
        return (
            f"{said} Below {limit} (IEEE 802.15.7) it may be seen as flicker: raise the switching "
            f"frequency, or send fewer bits. {SEIZURES}"
        )
    return f"{said} It is above {limit}, below which flicker may be seen (IEEE 802.15.7)."
