"""Check the result of a plug-in's decoder, all of whose parts others rely on."""

import math
from numbers import Integral

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import PluginError, quote
from occ_model.plugins import of_kind
from occ_model.results.decoding import DecodeResult, RunHistogram, Runs
from occ_model.scene.payload import MAX_PAYLOAD_BITS, form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.transmitter.plugin_checks import (
    require_bits,
    require_count,
    require_counts,
    require_failure,
    require_number,
    require_numbers,
    require_places,
)
from occ_model.transmitter.registry import MOST_CHIPS
from occ_model.transmitter.scheme import code_of

_SHORTEST_CHIP = 1e-6  # columns
_FARTHEST_CHIP = 10.0  # signal lengths before or after the signal within which a chip may begin


def check_result(who: str, result: DecodeResult, columns: int, scene: Scene) -> DecodeResult:
    """Return a result whose parts all comply with :class:`DecodeResult`, or raise PluginError.

    It must have as many bits as the scene sends, and the code and payload of these bits. The caller
    adds the decoder's name and the region.
    """
    bits = require_bits(who, "bits", result.bits, MAX_PAYLOAD_BITS)
    chips = require_bits(who, "chips", result.chips, max(columns, MOST_CHIPS))
    failure = require_failure(who, result.failure)
    code = None
    if failure is None:
        length = scene.transmitter.payload_length
        if len(bits) != length:
            raise PluginError(f"{who} gives {len(bits)} bits in place of {length}, and no failure.")
        code = code_of(bits.tolist())
        code_of_result: object = result.code
        if not isinstance(code_of_result, Integral) or code_of_result != code:
            raise PluginError(
                f"{who} gives code = {quote(code_of_result)} with bits that are {quote(code)}."
            )
    sent_payload = scene.transmitter.payload
    payload = payload_of_bits(bits.tolist(), form_of(sent_payload)) if sent_payload else ""
    payload_of_result: object = result.payload
    if not isinstance(payload_of_result, str) or payload_of_result not in ("", payload):
        raise PluginError(
            f"{who} gives payload = {quote(payload_of_result)} with bits that are {quote(payload)}."
        )

    def number(name: str, low: float = -math.inf, high: float = math.inf) -> float | None:
        return require_number(who, name, getattr(result, name), low, high)

    def numbers(
        name: str, length: int, low: float = -math.inf, high: float = math.inf
    ) -> FloatArray | None:
        return require_numbers(who, name, getattr(result, name), length, low, high)

    farthest = _FARTHEST_CHIP * columns
    starts = numbers("chip_starts", len(chips), -farthest, farthest)
    if starts is not None and (np.diff(starts) < 0.0).any():
        raise PluginError(f"{who} gives chip_starts that do not rise.")
    folded: object = result.model if result.folded is None else result.folded
    bins = min(len(folded), MOST_CHIPS) if isinstance(folded, np.ndarray) and folded.ndim else 1
    return DecodeResult(
        decoder="",
        failure=failure,
        code=code,
        bits=bits,
        payload=payload,
        signal=numbers("signal", columns),
        threshold=number("threshold"),
        runs=_runs(who, result.runs, columns),
        histograms=_histograms(who, result.histograms, columns),
        chip_length=number("chip_length", low=_SHORTEST_CHIP),
        chips=chips,
        chip_starts=starts,
        headers=require_places(who, "headers", result.headers, len(chips)),
        correlation=number("correlation", -1.0, 1.0),
        confidence=number("confidence", 0.0, 1.0),
        folded=numbers("folded", max(bins, 1)),
        model=numbers("model", max(bins, 1)),
        equalized=numbers("equalized", columns),
        light=numbers("light", columns),
        light_model=numbers("light_model", columns),
        chip_likelihoods=numbers("chip_likelihoods", len(chips), 0.0, 1.0),
        bit_likelihoods=numbers("bit_likelihoods", len(bits), 0.0, 1.0),
    )


def _runs(who: str, runs: object, columns: int) -> Runs | None:
    if runs is None:
        return None
    checked = of_kind(who, Runs)(runs)
    values = require_bits(who, "runs of values", checked.values, columns)
    lengths = require_counts(who, "lengths of runs", checked.lengths, columns)
    if len(values) != len(lengths) or lengths.sum() > columns:
        raise PluginError(f"{who} gives runs that are not those of {columns:,} columns.")
    return Runs(values, lengths)


def _histograms(
    who: str, histograms: object, columns: int
) -> tuple[RunHistogram, RunHistogram] | None:
    if histograms is None:
        return None
    if not isinstance(histograms, tuple) or len(histograms) != 2:
        raise PluginError(f"{who} gives histograms that are not two of runs.")
    first, second = (_histogram(who, histogram, columns) for histogram in histograms)
    return first, second


def _histogram(who: str, histogram: object, columns: int) -> RunHistogram:
    checked = of_kind(who, RunHistogram)(histogram)
    counts = require_counts(who, "counts of runs", checked.counts, columns + 1)
    if not counts.size:
        raise PluginError(f"{who} gives an empty histogram.")
    split: object = checked.split
    if split is not None:
        split = require_count(who, "split", split, 0, len(counts) - 1)
    return RunHistogram(counts, split)
