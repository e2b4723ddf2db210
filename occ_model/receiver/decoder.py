"""The interface of a decoder, and what is common to decoders: the last step, and a refusal."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from occ_model.arrays import FloatArray
from occ_model.results.decoding import DecodeResult
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.packet import code_of
from occ_model.transmitter.scheme import scheme_of


@dataclass(frozen=True, slots=True)
class Decoder:
    """A method to read a code from a signal.

    Parameters
    ----------
    name
        The identifier, as on the command line.
    read
        Reads a signal, the mean grey level of each column, shape (columns,), with the parameters of
        a scene that a receiver knows. The caller adds the region to the result.
    is_quick
        Whether it reads in a few milliseconds and imports nothing slow, so that every picture of a
        live view can be read with it.
    searched_chips
        The longest exposure, in chips, to which its limits are searched: where it takes so long
        beyond that nobody would wait.
    """

    name: str
    title: str
    read: Callable[[FloatArray, Scene], DecodeResult]
    is_quick: bool = True
    searched_chips: float = math.inf


def read_payload(result: DecodeResult, scene: Scene) -> DecodeResult:
    """Find frames among the chips of a result, and read the payload by the scene's scheme.

    Returns the result with headers, bits, code and payload, or with the failure that says why not.
    """
    return with_bits(result, scheme_of(scene.transmitter).decode(result.chips), scene)


def with_bits(result: DecodeResult, framed: Framed, scene: Scene) -> DecodeResult:
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


_MIN_CHIP_COLUMNS = 1.0  # columns of a chip below which not every chip has a column of its own
_DIGITS = 3  # significant digits of a time in a sentence


def columns_of_chip(scene: Scene) -> float:
    """Return the columns that are read out while one chip lasts."""
    return scene.transmitter.switching_period / scene.camera.readout_time


def has_short_chips(scene: Scene) -> bool:
    """Return whether a chip ends before the next column begins."""
    return columns_of_chip(scene) < _MIN_CHIP_COLUMNS


def with_short_chips(failure: str, scene: Scene) -> str:
    """Put before a failure that chips are too short, where they are and cause it."""
    return f"{_sentence(scene)} {failure}" if has_short_chips(scene) else failure


def then_short_chips(failure: str, scene: Scene) -> str:
    """Add to a failure that chips are too short, where they are: it may have another cause."""
    return f"{failure} {_sentence(scene)}" if has_short_chips(scene) else failure


def whole_chips(chips: float) -> int:
    """Count the whole chips of a number of them that may be off by its rounding."""
    return int(chips * (1.0 + 1e-12))


def short_view(columns: int, needed: int, scene: Scene, longest_exposure: float = math.inf) -> str:
    """Say how many of the chips that are needed so many columns show, and what would show more.

    ``longest_exposure``: in chips, up to which a decoder reads.
    """
    shown = whole_chips(columns / columns_of_chip(scene))
    ways = ["come closer"] if columns < scene.camera.columns else []
    # At the frequency at which the chips fit.
    exposure = scene.camera.exposure_time / scene.camera.readout_time * needed / columns
    if columns >= needed and exposure < longest_exposure:
        ways.append("raise the frequency")
    advice = f"; {' or '.join(ways)}" if ways else ""
    return f"{shown} of {needed} chips fit the panel's image{advice}."


def _sentence(scene: Scene) -> str:
    chip, column = scene.transmitter.switching_period, scene.camera.readout_time
    return (
        f"A chip of {SECOND.format(chip, _DIGITS)} is shorter than the "
        f"{SECOND.format(column, _DIGITS)} from one column to the next: not every chip has a "
        "column of its own."
    )
