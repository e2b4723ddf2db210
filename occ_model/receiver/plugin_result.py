"""Check what a plug-in's decoder gives, before other parts of the program show or count it."""

from numbers import Integral, Real

import numpy as np

from occ_model.errors import shown
from occ_model.results.decoding import DecodeResult
from occ_model.scene.payload import MAX_PAYLOAD_BITS
from occ_model.transmitter.plugin_values import (
    MOST_CHIPS,
    are_places,
    excess,
    is_bits,
    is_reason,
)

_LONGEST_PAYLOAD = 4 * MAX_PAYLOAD_BITS  # letters: bits, as text, are the longest form


def problem_of(result: object, columns: int) -> str | None:
    """Say what is wrong with a plug-in's result, as the end of a sentence; None if nothing is."""
    if not isinstance(result, DecodeResult):
        return f"no DecodeResult but a {type(result).__name__}"
    return (
        _problem_of_size(result, max(columns, MOST_CHIPS))
        or _problem_of_code(result)
        or _problem_of_values(result, columns)
    )


def _problem_of_size(result: DecodeResult, most: int) -> str | None:
    """Look at what has a length of its own; that of the rest follows from it."""
    code: object = result.code
    if isinstance(code, int) and code.bit_length() > MAX_PAYLOAD_BITS:
        return f"a code of more than {MAX_PAYLOAD_BITS:,} bits"
    found = (
        excess("bits", result.bits, MAX_PAYLOAD_BITS),
        excess("letters of a payload", result.payload, _LONGEST_PAYLOAD),
        excess("chips", result.chips, most),
        excess("headers", result.headers, most),
        excess("folded levels", result.folded, most),
        excess("levels of the model", result.model, most),
    )
    return next(filter(None, found), None)


def _problem_of_code(result: DecodeResult) -> str | None:
    code: object = result.code
    payload: object = result.payload
    for name in ("bits", "chips"):
        if not is_bits(getattr(result, name)):
            return f"{name} that are not an array of zeros and ones"
    if not is_reason(result.failure):
        return "a failure that is not a sentence"
    if result.failure is None and (code is None or not result.bits.size):
        return "neither a code with its bits nor a failure"
    if code is not None and (not isinstance(code, Integral) or int(code) < 0):
        return f"the code {shown(code)}, which is not a whole number from 0"
    if not isinstance(payload, str):
        return f"the payload {shown(payload)}, which is not text"
    return None


def _problem_of_values(result: DecodeResult, columns: int) -> str | None:
    for name in ("threshold", "chip_length", "correlation", "confidence"):
        value: object = getattr(result, name)
        if value is not None and not isinstance(value, Real):
            return f"{name} = {shown(value)}, which is not a number"
    chips, bits = len(result.chips), len(result.bits)
    lengths = {
        "signal": columns, "equalized": columns, "light": columns, "light_model": columns,
        "chip_starts": chips, "chip_likelihoods": chips, "bit_likelihoods": bits,
    }  # fmt: skip
    for name in ("folded", "model", *lengths):
        values = getattr(result, name)
        if values is not None and not _is_line(values, lengths.get(name)):
            return f"{name} that is not an array of as many numbers as it should"
    if not are_places(result.headers, chips):
        return f"the headers {shown(result.headers)}, which are not places among its chips"
    return None


def _is_line(values: object, length: int | None) -> bool:
    """Whether values are an array of numbers of one dimension, of a length if one is given."""
    return (
        isinstance(values, np.ndarray)
        and values.ndim == 1
        and values.dtype.kind in "fiu"
        and length in (None, len(values))
    )
