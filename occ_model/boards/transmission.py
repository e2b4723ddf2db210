"""What a board sends for a scene: its chips or its lamp's period, and visible flicker.

A chip's length is rounded to whole cycles of the clock, and the error is stated exactly. Spreading
the fraction over the chips would keep the mean frequency but move single edges by up to half a
cycle, which cannot be corrected in a photo, whereas the exact frequency can be put into the scene.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import ClassVar

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.boards.board import TransmitterBoard
from occ_model.boards.timing import BoardTiming, LampBoardTiming, choose_lamp_timing, choose_timing
from occ_model.errors import ParameterError
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, PERCENT, SECOND
from occ_model.transmitter.line_codes.line_code import VISIBLE_LIMIT
from occ_model.transmitter.scheme import packet, shortest_period


@dataclass(frozen=True, eq=False)
class Transmission:
    """One period of the chips that a board repeats, and their length."""

    scene: Scene
    board: TransmitterBoard
    chips: ByteArray  # Shape (chips,): one period in the order sent; 1 is lit
    timing: BoardTiming

    unit: ClassVar = "chip"  # Name of the timing's period
    frequency: ClassVar = "switching frequency"  # Name of the timing's frequency
    repeats: ClassVar = "packet"  # Name of what is sent again and again
    part: ClassVar = "chip"  # Name of a part that is lit or dark

    @property
    def sent_values(self) -> dict[str, float]:
        """The scene's parameters as they are actually sent."""
        return {"switching_frequency": float(self.timing.frequency)}

    @property
    def sent_scene(self) -> Scene:
        """The scene with the values that are actually sent."""
        return self.scene.replace(**self.sent_values)

    @property
    def is_exact(self) -> bool:
        """Whether the scene's values are those sent, to the precision of its numbers."""
        return self.sent_scene == self.scene

    def start_of(self, chip: int) -> int:
        """Return the clock cycles before a chip; the index after the last chip gives all."""
        return chip * self.timing.cycles

    def samples(self, count: int) -> ByteArray:
        """Return one period in samples, ``count`` for each unit of the timing; 1 is lit."""
        return np.repeat(self.chips, count)

    @cached_property
    def edges(self) -> tuple[int, ...]:
        """Indices of the chips that differ from the chip before, in the repeated period."""
        return tuple(np.flatnonzero(self.chips != np.roll(self.chips, 1)).tolist())

    @property
    def longest_run(self) -> Fraction | None:
        """Longest time in s without an edge in the repeated period; None if there are no edges."""
        if not self.edges:
            return None
        starts = [self.start_of(edge) for edge in self.edges]
        starts.append(starts[0] + self.start_of(len(self.chips)))
        return Fraction(max(end - start for start, end in pairwise(starts)), self.timing.clock)

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


@dataclass(frozen=True, eq=False)
class LampTransmission(Transmission):
    """One period of a lamp that a board blinks: lit, then dark."""

    timing: LampBoardTiming

    unit: ClassVar = "period"
    frequency: ClassVar = "frequency"
    repeats: ClassVar = "period"
    part: ClassVar = "part"

    @property
    def sent_values(self) -> dict[str, float]:
        frequency = float(self.timing.frequency)
        if self.scene.transmitter.light == "pulses":
            return {"pulse_frequency": frequency, "pulse_length": float(self.timing.lit_time)}
        return {"lamp_frequency": frequency, "duty": float(self.timing.duty)}

    def start_of(self, chip: int) -> int:
        return (0, self.timing.lit_cycles, self.timing.cycles)[chip]

    def samples(self, count: int) -> ByteArray:
        lit = min(max(round(self.timing.duty * count), 1), count - 1)
        return np.repeat(self.chips, [lit, count - lit])

    @property
    def lowest_frequency(self) -> Fraction:
        return self.timing.frequency


def prepare_transmission(scene: Scene, board: TransmitterBoard) -> Transmission:
    """Prepare the transmission of a scene; ParameterError if the board cannot send it."""
    if scene.transmitter.light != "code":
        return _prepare_lamp(scene, board)
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


def _prepare_lamp(scene: Scene, board: TransmitterBoard) -> LampTransmission:
    transmitter, duty, length = scene.transmitter, Fraction(scene.transmitter.duty), None
    if transmitter.light == "pulses":
        name, frequency = "pulse_frequency", transmitter.pulse_frequency
        length = transmitter.pulse_length
        if Fraction(length) * Fraction(frequency) >= 1:
            longest = f"below {SECOND.format(1.0 / frequency)}: others are steady light"
            raise _refuse(board, "pulse_length", SECOND.format(length), longest)
    elif transmitter.light == "lamp":
        name, frequency = "lamp_frequency", transmitter.lamp_frequency
        if transmitter.depth != 1.0:
            raise _refuse(
                board, "depth", PERCENT.format(transmitter.depth), f"100 %, since {_ON_OR_OFF}"
            )
        if not 0 < duty < 1:
            raise _refuse(
                board, "duty", PERCENT.format(transmitter.duty),
                "more than 0 % and less than 100 %: others are steady light",
            )  # fmt: skip
    else:
        raise _refuse(
            board, "light", transmitter.light, f"code, lamp or pulses, since {_ON_OR_OFF}"
        )
    timing = choose_lamp_timing(
        board, name, frequency,
        lambda period: duty * period if length is None else Fraction(length),
    )  # fmt: skip
    return LampTransmission(scene, board, np.array([1, 0], dtype=np.uint8), timing)


_ON_OR_OFF = "a pin is either on or off"


def _refuse(board: TransmitterBoard, name: str, value: str, allowed: str) -> ParameterError:
    return ParameterError.of(
        name, value, allowed, condition=f"on {board.title}", parameters=(name,)
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


def flicker_sentence(transmission: Transmission) -> str:
    """State the lowest frequency in the light, and whether it is visible."""
    lowest, run = transmission.lowest_frequency, transmission.longest_run
    if lowest is None or run is None:
        return "The light does not change: all chips are equal."
    limit = HERTZ.format(VISIBLE_LIMIT)
    is_lamp = isinstance(transmission, LampTransmission)
    facts = (
        f"The lowest frequency in the light is {HERTZ.format(float(lowest), 4)}, at which the "
        f"{'lamp blinks' if is_lamp else 'packet repeats'}; its longest time without an edge is "
        f"{SECOND.format(float(run), 4)}."
    )
    if transmission.is_visible:
        remedy = "its frequency" if is_lamp else "the switching frequency, or send fewer bits"
        return (
            f"{facts} Below {limit} (IEEE 802.15.7) it may be seen as flicker: raise {remedy}. "
            f"{SEIZURES}"
        )
    return f"{facts} It is above {limit}, below which flicker may be seen (IEEE 802.15.7)."
