"""Check the result of a plug-in's decoder."""

from dataclasses import replace

import numpy as np

from occ_model.errors import PluginError, one_line, quote
from occ_model.results.decoding import DecodeResult
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.transmitter.registry import require_bits
from occ_model.transmitter.scheme import code_of


def check_result(who: str, result: DecodeResult, columns: int, scene: Scene) -> DecodeResult:
    """Return a result, or raise PluginError if its parts contradict each other.

    Without a failure it must have as many bits as the scene sends, and their code and payload.
    Arrays must be as long as what they stand beside.
    """
    bits = require_bits(who, "bits", result.bits)
    chips = require_bits(who, "chips", result.chips)
    failure, code = result.failure, None
    if failure is None:
        length = scene.transmitter.payload_length
        if len(bits) != length:
            raise PluginError(f"{who} gives {len(bits)} bits in place of {length}, and no failure.")
        code = code_of(bits.tolist())
        if result.code != code:
            raise PluginError(
                f"{who} gives code = {quote(result.code)} with bits that are {quote(code)}."
            )
    else:
        failure = one_line(failure)
    sent_payload = scene.transmitter.payload
    payload = payload_of_bits(bits.tolist(), form_of(sent_payload)) if sent_payload else ""
    if result.payload not in ("", payload):
        raise PluginError(
            f"{who} gives payload = {quote(result.payload)} with bits that are {quote(payload)}."
        )
    for length, names in (
        (columns, ("signal", "equalized", "light", "light_model")),
        (len(chips), ("chip_starts", "chip_likelihoods")),
        (len(bits), ("bit_likelihoods",)),
    ):
        for name in names:
            values = getattr(result, name)
            if values is not None and np.shape(values) != (length,):
                raise PluginError(
                    f"{who} gives {name} of the shape {np.shape(values)}; allowed: ({length},)."
                )
    return replace(
        result, failure=failure, code=code, bits=bits, chips=chips, payload=payload, region=None
    )
