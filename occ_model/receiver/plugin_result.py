"""Check what a plug-in's decoder gives, before other parts of the program show or count it."""

import math
from numbers import Integral, Real

import numpy as np

from occ_model.errors import shown
from occ_model.results.decoding import DecodeResult, RunHistogram, Runs
from occ_model.scene.payload import MAX_PAYLOAD_BITS
from occ_model.transmitter.plugin_values import MOST_CHIPS, excess, is_bits, is_reason

_RANGES = {
    "threshold": (-math.inf, math.inf),
    "chip_length": (0.0, math.inf),
    "correlation": (-1.0, 1.0),
    "confidence": (0.0, 1.0),
}
"""Lowest and highest value of the numbers of a result."""

_ROUNDING = 1e-9

_OWN_LENGTHS = {
    "chips": "chips",
    "headers": "headers",
    "folded": "folded levels",
    "model": "levels of the model",
}
"""Parts of a result that are not as long as another one, and what they consist of."""

_LONGEST_PAYLOAD = 4 * MAX_PAYLOAD_BITS
"""Letters: bits, as text, are the longest form."""


def problem_of(result: object, columns: int) -> str | None:
    """Say what is wrong with a result, as the end of a sentence; None if nothing is.

    ``result``: what the plug-in has given. ``columns``: length of the signal that it was given.
    """
    if not isinstance(result, DecodeResult):
        return f"no DecodeResult but a {type(result).__name__}"
    if problem := _problem_of_size(result, max(columns, MOST_CHIPS)):
        return problem
    for name in ("bits", "chips"):
        if not is_bits(getattr(result, name)):
            return f"{name} that are not an array of zeros and ones"
    return (
        _problem_of_code(result)
        or _problem_of_numbers(result)
        or _problem_of_arrays(result, columns)
        or _problem_of_runs(result)
    )


def _problem_of_size(result: DecodeResult, most: int) -> str | None:
    """Look at what has a length of its own; that of the rest follows from it."""
    code: object = result.code
    if _is_whole(code) and int(code).bit_length() > MAX_PAYLOAD_BITS:  # type: ignore[call-overload]
        return f"a code of more than {MAX_PAYLOAD_BITS:,} bits"
    found = [
        excess("bits", result.bits, MAX_PAYLOAD_BITS),
        excess("letters of a payload", result.payload, _LONGEST_PAYLOAD),
        *(excess(what, getattr(result, name), most) for name, what in _OWN_LENGTHS.items()),
    ]
    if isinstance(result.runs, Runs):
        found += [excess("runs", part, most) for part in (result.runs.values, result.runs.lengths)]
    if isinstance(result.histograms, tuple):
        found += [
            excess("lengths of runs", each.counts, most + 1)
            for each in result.histograms[:2]
            if isinstance(each, RunHistogram)
        ]
    return next(filter(None, found), None)


def _problem_of_code(result: DecodeResult) -> str | None:
    failure: object = result.failure
    code: object = result.code
    payload: object = result.payload
    if not is_reason(failure):
        return "a failure that is not a sentence"
    if failure is None and (code is None or not result.bits.size):
        return "neither a code with its bits nor a failure"
    if code is not None and (not _is_whole(code) or code < 0):  # type: ignore[operator]
        return f"the code {shown(code)}, which is not a whole number from 0"
    if not isinstance(payload, str):
        return f"the payload {shown(payload)}, which is not text"
    return None


def _problem_of_numbers(result: DecodeResult) -> str | None:
    for name, (low, high) in _RANGES.items():
        value: object = getattr(result, name)
        if value is None:
            continue
        is_number = isinstance(value, Real) and math.isfinite(value)
        if not is_number or not low - _ROUNDING <= value <= high + _ROUNDING:  # type: ignore[operator]
            return f"{name} = {shown(value)}; allowed: a number from {low:g} to {high:g}, or None"
    return None


def _problem_of_arrays(result: DecodeResult, columns: int) -> str | None:
    chips, bits = len(result.chips), len(result.bits)
    lengths = {
        "signal": columns, "equalized": columns, "light": columns, "light_model": columns,
        "chip_starts": chips, "chip_likelihoods": chips, "bit_likelihoods": bits,
    }  # fmt: skip
    for name in ("folded", "model", *lengths):
        values = getattr(result, name)
        if values is not None and not _is_line(values, lengths.get(name)):
            return f"{name} that is not an array of as many finite numbers as it should"
    headers: object = result.headers
    if not isinstance(headers, tuple) or not all(
        _is_whole(place) and 0 <= place < chips for place in headers
    ):
        return f"the headers {shown(headers)}, which are not places among its chips"
    return None


def _problem_of_runs(result: DecodeResult) -> str | None:
    runs: object = result.runs
    if runs is not None and not (
        isinstance(runs, Runs)
        and is_bits(runs.values)
        and _are_counts(runs.lengths)
        and len(runs.values) == len(runs.lengths)
    ):
        return "runs that are no Runs of zeros and ones with their lengths"
    histograms: object = result.histograms
    if histograms is not None and not (
        isinstance(histograms, tuple)
        and len(histograms) == 2
        and all(
            isinstance(each, RunHistogram)
            and _are_counts(each.counts)
            and (each.split is None or _is_whole(each.split))
            for each in histograms
        )
    ):
        return "histograms that are not two RunHistograms"
    return None


def _is_whole(value: object) -> bool:
    return isinstance(value, Integral) and not isinstance(value, bool)


def _is_line(values: object, length: int | None) -> bool:
    """Whether values are an array of finite numbers of one dimension, of a length if one is given.

    An array that is masked could hide numbers from some operations and not from others.
    """
    return (
        isinstance(values, np.ndarray)
        and not isinstance(values, np.ma.MaskedArray)
        and values.ndim == 1
        and values.dtype.kind in "fiu"
        and length in (None, len(values))
        and bool(np.isfinite(values).all())
    )


def _are_counts(values: object) -> bool:
    return (
        isinstance(values, np.ndarray)
        and values.ndim == 1
        and values.dtype.kind in "iu"
        and bool((values >= 0).all())
    )
