"""The interface of decoders, and what they share: reading the payload and explaining failures."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from occ_model.arrays import FloatArray
from occ_model.results.decoding import DecodeResult
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.scheme import code_of, scheme_of


@dataclass(frozen=True, slots=True)
class Decoder:
    """A method to read a code from a signal.

    Parameters
    ----------
    name
        The identifier, as on the command line.
    read
        Function that reads a signal, the mean grey level of each column, shape (columns,), with the
        parameters of a scene that a receiver knows. The caller adds the region to the result.
    read_many
        The same function of several signals and of a scene for each, where it is faster than one
        call after the other; its results are the same.
    is_quick
        Whether it takes a few milliseconds and imports nothing slow, so that a live view can read
        every picture.
    searched_chips
        The longest exposure, in chips, for which its limits are searched; longer ones take too
        long.
    """

    name: str
    title: str
    read: Callable[[FloatArray, Scene], DecodeResult]
    read_many: Callable[[Sequence[FloatArray], Sequence[Scene]], list[DecodeResult]] | None = None
    is_quick: bool = True
    searched_chips: float = math.inf


def read_payload(result: DecodeResult, scene: Scene) -> DecodeResult:
    """Find frames in the chips of a result, and read the payload by the scene's scheme.

    Returns the result with headers, bits, code and payload, or with a failure.
    """
    return add_bits(result, scheme_of(scene.transmitter).decode(result.chips), scene)


def add_bits(result: DecodeResult, framed: Framed, scene: Scene) -> DecodeResult:
    payload = scene.transmitter.payload
    bits = framed.bits.tolist()
    return replace(
        result,
        headers=framed.headers,
        bits=framed.bits,
        code=code_of(bits) if framed.failure is None else None,
        payload=payload_of_bits(bits, form_of(payload)) if payload else "",
        failure=framed.failure,
    )


_MIN_CHIP_COLUMNS = 1.0  # columns per chip below which not every chip has a column of its own
_DIGITS = 3  # significant digits of a time in a sentence


def columns_of_chip(scene: Scene) -> float:
    """Return the number of columns that are read out during one chip."""
    return scene.transmitter.switching_period / scene.camera.readout_time


def has_short_chips(scene: Scene) -> bool:
    """Return whether a chip ends before the next column begins."""
    return columns_of_chip(scene) < _MIN_CHIP_COLUMNS


def blame_short_chips(failure: str, scene: Scene) -> str:
    """State before a failure that chips are too short, if they are, as its cause."""
    return f"{_describe_short_chips(scene)} {failure}" if has_short_chips(scene) else failure


def mention_short_chips(failure: str, scene: Scene) -> str:
    """Add to a failure that chips are too short, if they are; it may have another cause."""
    return f"{failure} {_describe_short_chips(scene)}" if has_short_chips(scene) else failure


def count_whole_chips(chips: float) -> int:
    """Return the whole chips in a number of chips that may have a rounding error."""
    return int(chips * (1.0 + 1e-12))


def describe_short_view(
    columns: int, needed_chips: int, scene: Scene, longest_exposure: float = math.inf
) -> str:
    """State how many of the needed chips are visible, and how to see more.

    ``longest_exposure``: the longest exposure in chips that the decoder reads.
    """
    visible_chips = count_whole_chips(columns / columns_of_chip(scene))
    remedies = ["come closer"] if columns < scene.camera.columns else []
    # The exposure, in chips, at the frequency at which all needed chips fit.
    exposure = scene.camera.exposure_time / scene.camera.readout_time * needed_chips / columns
    if columns >= needed_chips and exposure < longest_exposure:
        remedies.append("raise the frequency")
    advice = f"; {' or '.join(remedies)}" if remedies else ""
    return f"{visible_chips} of {needed_chips} chips fit the panel's image{advice}."


def _describe_short_chips(scene: Scene) -> str:
    chip, column = scene.transmitter.switching_period, scene.camera.readout_time
    return (
        f"A chip of {SECOND.format(chip, _DIGITS)} is shorter than the "
        f"{SECOND.format(column, _DIGITS)} from one column to the next: not every chip has a "
        "column of its own."
    )
