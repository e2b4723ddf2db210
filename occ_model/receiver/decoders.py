"""The decoders by name: the built-in ones and those of plug-ins, whose results are checked."""

from dataclasses import replace
from functools import lru_cache
from numbers import Integral, Real

import numpy as np

from occ_model import plugins
from occ_model.arrays import FloatArray
from occ_model.errors import ParameterError, PluginError, one_line, shown
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.equalizer import DECODER as EQUALIZER
from occ_model.receiver.matched.decoder import DECODER as MATCHED
from occ_model.receiver.threshold import DECODER as THRESHOLD
from occ_model.results.decoding import DecodeResult, Region, RunHistogram, Runs
from occ_model.scene.payload import MAX_PAYLOAD_BITS
from occ_model.scene.scene import Scene
from occ_model.transmitter.registry import (
    MOST_CHIPS,
    check_kinds,
    check_places,
    checked_bits,
    plain_reason,
)


def _read_sequence(signal: FloatArray, scene: Scene) -> DecodeResult:
    # Its search is imported when first needed: most signals are read without it.
    from occ_model.receiver.sequence.decoder import read_signal

    return read_signal(signal, scene)


SEQUENCE = Decoder(
    "sequence",
    "Sequence: the most likely chips",
    _read_sequence,
    is_quick=False,
    # A picture takes 0.02 s up to 7 chips, 0.1 s at 10 and several at 14.
    searched_chips=8.0,
)

DECODERS: dict[str, Decoder] = {  # the built-in decoders by name
    decoder.name: decoder for decoder in (THRESHOLD, MATCHED, EQUALIZER, SEQUENCE)
}


def decoders() -> tuple[str, ...]:
    """Return the names of all decoders, those of plug-ins last."""
    return tuple(dict.fromkeys((*DECODERS, *plugins.plugin_names(plugins.DECODERS))))


QUICK_DECODERS = tuple(name for name, decoder in DECODERS.items() if decoder.is_quick)
"""The names of the decoders that every picture of the window is read with."""


def decoder_named(name: str) -> Decoder:
    if isinstance(name, str):
        if name in DECODERS:
            return DECODERS[name]
        if name in decoders():
            return _plugin(name)
    raise ParameterError.of("decoder", shown(name), ", ".join(decoders()))


@lru_cache(maxsize=64)
def _plugin(name: str) -> Decoder:
    """Import a plug-in's decoder; its faults become sentences."""
    offered = plugins.load_plugin(plugins.DECODERS, name, Decoder)
    who = plugins.described(plugins.DECODERS, name)

    def read(signal: FloatArray, scene: Scene) -> DecodeResult:
        # It cannot change the signal that other decoders read after it.
        own = np.array(signal)
        try:
            result = plugins.called(who, "read", DecodeResult, offered.read, own, scene)
            return replace(checked_result(who, result, len(own)), decoder=name)
        except (ParameterError, PluginError) as error:
            return DecodeResult(name, signal=signal, failure=str(error))

    return Decoder(name, one_line(str(offered.title)), read)


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
