"""What a board sends of a scene: chips, timing, and how much of it the eye may see."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.boards.board import Board
from occ_model.boards.timing import ChipTiming, best_timing
from occ_model.errors import ParameterError
from occ_model.scene.scene import Scene
from occ_model.transmitter.line_codes.line_code import VISIBLE_LIMIT
from occ_model.transmitter.packet import packet, shortest_period


@dataclass(frozen=True, eq=False)
class Transmission:
    """One period of the chips that a board sends over and over, and how long each lasts."""

    scene: Scene
    board: Board
    chips: ByteArray  # Shape (chips,): one period, first sent first; 1 is lit
    timing: ChipTiming

    @property
    def sent_scene(self) -> Scene:
        """The scene with the switching frequency that is really sent."""
        return self.scene.replace(switching_frequency=float(self.timing.frequency))

    @cached_property
    def edges(self) -> tuple[int, ...]:
        """The chips of a period that differ from the one before, the last before the first."""
        return tuple(np.flatnonzero(self.chips != np.roll(self.chips, 1)).tolist())

    @property
    def longest_run(self) -> Fraction | None:
        """The longest time in s without an edge, across the end of a period; None without edges."""
        if not self.edges:
            return None
        following = (*self.edges[1:], self.edges[0] + len(self.chips))
        runs = (end - start for start, end in zip(self.edges, following, strict=True))
        return max(runs) * self.timing.period

    @property
    def lowest_frequency(self) -> Fraction | None:
        """Lowest frequency in Hz that the light contains; None where it never changes."""
        if not self.edges:
            return None
        return self.timing.frequency / shortest_period(self.chips)

    @property
    def is_visible(self) -> bool:
        """Whether the light contains frequencies that may be seen as flicker."""
        return self.lowest_frequency is not None and self.lowest_frequency < VISIBLE_LIMIT


def transmission(scene: Scene, board: Board) -> Transmission:
    """Prepare what a board sends.

    Raises ParameterError: the board cannot blink at that frequency or store the packet.
    """
    chips = packet(scene)
    room = table_size(board, len(chips))
    if room > board.table_bytes:
        raise ParameterError(
            f"The packet has {len(chips):,} chips, which take {room:,} bytes on {board.title}; "
            f"allowed: {board.table_bytes:,} bytes. Send fewer bits.",
            parameters=("payload", "line_code", "framing"),
        )
    return Transmission(
        scene, board, chips, best_timing(board, scene.transmitter.switching_frequency)
    )


def table_size(board: Board, chips: int) -> int:
    """Count a packet's bytes on a board: MicroPython unpacks periods into words of 32 chips."""
    if board.language == "MicroPython":
        return chips * repeats_to_words(chips) // 8
    return -(-chips // 8)


def repeats_to_words(chips: int) -> int:
    """Count the periods that fill whole words of 32 chips."""
    return next(times for times in (1, 2, 4, 8, 16, 32) if chips * times % 32 == 0)
