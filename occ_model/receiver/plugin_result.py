"""Check what a plug-in's decoder gives, before other parts of the program show or count it."""

from dataclasses import replace
from numbers import Integral, Real

import numpy as np

from occ_model.errors import PluginError
from occ_model.results.decoding import DecodeResult, Region, RunHistogram, Runs
from occ_model.scene.payload import MAX_PAYLOAD_BITS
from occ_model.transmitter.plugin_values import (
    MOST_CHIPS,
    check_kinds,
    check_places,
    checked_bits,
    plain_reason,
)


def checked_result(who: str, result: DecodeResult, columns: int) -> DecodeResult:
    """Return the result with bits and chips as bytes, or raise a PluginError."""
    bits = checked_bits(who, "bits", result.bits, MAX_PAYLOAD_BITS)
    chips = checked_bits(who, "chips", result.chips, max(columns, MOST_CHIPS))
    lengths = {
        "signal": columns, "equalized": columns, "light": columns, "light_model": columns,
        "chip_starts": len(chips), "chip_likelihoods": len(chips), "bit_likelihoods": len(bits),
    }  # fmt: skip
    check_kinds(
        who, result, failure=str | None, code=Integral | None, payload=str,
        threshold=Real | None, chip_length=Real | None, correlation=Real | None,
        confidence=Real | None, folded=np.ndarray | None, model=np.ndarray | None,
        region=Region | None, runs=Runs | None, histograms=tuple | None,
        **dict.fromkeys(lengths, np.ndarray | None),
    )  # fmt: skip
    check_places(who, "headers", result.headers, len(chips))
    for one in result.histograms or ():
        if not isinstance(one, RunHistogram) or len(result.histograms or ()) != 2:
            raise PluginError(f"{who} gives histograms that are not two of runs.")
    if not result.failure and (result.code is None or result.code < 0 or not bits.size):
        raise PluginError(f"{who} gives neither a code with its bits nor a failure.")
    for name, length in lengths.items():
        values = getattr(result, name)
        if values is not None and values.shape != (length,):
            raise PluginError(
                f"{who} gives {name} of the shape {values.shape} in place of ({length},)."
            )
    return replace(
        result, bits=bits, chips=chips, failure=plain_reason(result.failure), location=None
    )
