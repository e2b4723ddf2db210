"""The decoders by name: the built-in ones and those of plug-ins, and the default."""

from functools import lru_cache

import numpy as np

from occ_model import plugins
from occ_model.arrays import FloatArray
from occ_model.errors import ParameterError, PluginError, shown
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.equalizer.decoder import DECODER as EQUALIZER
from occ_model.receiver.matched.decoder import DECODER as MATCHED
from occ_model.receiver.sequence.decoder import DECODER as SEQUENCE
from occ_model.receiver.threshold.decoder import DECODER as THRESHOLD
from occ_model.results import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.transmitter.line_codes.registry import is_bits

PAPER_DECODER = THRESHOLD.name
"""The name of the paper's decoder, which is the default."""

DECODERS: dict[str, Decoder] = {
    decoder.name: decoder for decoder in (THRESHOLD, MATCHED, EQUALIZER, SEQUENCE)
}
"""The built-in decoders by name."""


def decoders() -> tuple[str, ...]:
    """Return the names of all decoders, those of plug-ins last."""
    return tuple(dict.fromkeys((*DECODERS, *plugins.plugin_names(plugins.DECODERS))))


QUICK_DECODERS = tuple(name for name, decoder in DECODERS.items() if decoder.is_quick)
"""The names of the decoders that every picture of the window is read with."""


def decoder_named(name: str) -> Decoder:
    """Find a decoder.

    Raises
    ------
    ParameterError
        No decoder has that name; the message lists the known names.
    PluginError
        It is a plug-in that cannot be used.
    """
    if isinstance(name, str):
        if name in DECODERS:
            return DECODERS[name]
        if name in decoders():
            return _plugin(name)
    raise ParameterError(f"There is no decoder {shown(name)}; known: {', '.join(decoders())}.")


@lru_cache(maxsize=64)
def _plugin(name: str) -> Decoder:
    """Import a plug-in's decoder; its faults become sentences."""
    offered = plugins.load_plugin(plugins.DECODERS, name, Decoder)
    who = plugins.described(plugins.DECODERS, name)

    def read(signal: FloatArray, scene: Scene) -> DecodeResult:
        # It cannot change the signal that other decoders read after it.
        own = np.array(signal)
        try:
            result = offered.read(own, scene)
            problem = _problem(result)
        except plugins.FAULTS as error:
            return DecodeResult(
                name, signal=signal, failure=f"{who} fails: {plugins.reason(error)}"
            )
        if problem:
            return DecodeResult(name, signal=signal, failure=f"{who} gives {problem}.")
        return result

    try:
        title = str(offered.title)
    except plugins.FAULTS as error:
        raise PluginError(f"{who} has no title: {plugins.reason(error)}") from None
    return Decoder(name, title, read)


def _problem(result: object) -> str | None:
    """Say what is wrong with the result of a plug-in, None if nothing is."""
    if not isinstance(result, DecodeResult):
        return f"no DecodeResult but a {type(result).__name__}"
    if not is_bits(result.bits):
        return "bits that are not an array of zeros and ones"
    if result.failure is None and (result.code is None or not result.bits.size):
        return "neither a code with its bits nor a failure"
    failure: object = result.failure
    if failure is not None and not isinstance(failure, str):
        return "a failure that is no sentence"
    return None
