"""Find decoders by name: built-in ones, and those of plug-ins, whose results are checked."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from occ_model import plugins
from occ_model.arrays import FloatArray
from occ_model.errors import ParameterError, PluginError, shown
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.equalizer import DECODER as EQUALIZER
from occ_model.receiver.matched.decoder import DECODER as MATCHED
from occ_model.receiver.plugin_result import checked_result
from occ_model.receiver.threshold import DECODER as THRESHOLD
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.transmitter.plugin_checks import checked_text


def _read_sequence(signal: FloatArray, scene: Scene) -> DecodeResult:
    # Imported when first needed, because most signals are read without it.
    from occ_model.receiver.sequence.decoder import read_signal

    return read_signal(signal, scene)


SEQUENCE = Decoder(
    "sequence",
    "Sequence: the most likely chips",
    _read_sequence,
    is_quick=False,
    # A picture takes 0.02 s up to 7 chips, 0.1 s at 10 chips and several seconds at 14.
    searched_chips=8.0,
)

DECODERS: dict[str, Decoder] = {  # the built-in decoders by name
    decoder.name: decoder for decoder in (THRESHOLD, MATCHED, EQUALIZER, SEQUENCE)
}


def decoders() -> tuple[str, ...]:
    """Return the names of all decoders, with those of plug-ins last."""
    return tuple(dict.fromkeys((*DECODERS, *plugins.plugin_names(plugins.DECODERS))))


QUICK_DECODERS = tuple(name for name, decoder in DECODERS.items() if decoder.is_quick)
"""The names of the decoders with which every picture of the window is read."""


def decoder_named(name: str) -> Decoder:
    if isinstance(name, str):
        if name in DECODERS:
            return DECODERS[name]
        if name in decoders():
            return _plugin(name)
    raise ParameterError.of("decoder", shown(name), ", ".join(decoders()))


def read_with(decoder: str, signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read a signal with a named decoder; a plug-in's fault becomes the result's failure."""
    read = decoder_named(decoder).read
    try:
        result = read(signal, scene)
    except PluginError as fault:
        plugins.note_reading(decoder, str(fault))
        return DecodeResult(decoder, signal=signal, failure=str(fault))
    plugins.note_reading(decoder, None)
    return result


@lru_cache(maxsize=64)
def _plugin(name: str) -> Decoder:
    """Import a plug-in's decoder, whose faults become sentences."""
    offered = plugins.load_plugin(plugins.DECODERS, name, Decoder)
    who = plugins.described(plugins.DECODERS, name)

    def read(signal: FloatArray, scene: Scene) -> DecodeResult:
        def checked(result: object) -> DecodeResult:
            found = plugins.of_kind(who, DecodeResult)(result)
            return replace(checked_result(who, found, len(signal), scene), decoder=name)

        try:
            # A copy, because other decoders read the signal afterwards.
            return plugins.called(who, "read", checked, offered.read, np.array(signal), scene)
        except ParameterError as error:
            raise PluginError(str(error), parameters=error.parameters) from None

    title = plugins.called(
        who, "be used", lambda title: checked_text(who, "title", title), lambda: offered.title
    )
    return Decoder(name, title, read)
