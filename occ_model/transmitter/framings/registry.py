"""The framings by name: the built-in ones and those of plug-ins."""

from dataclasses import replace
from functools import lru_cache
from importlib import import_module

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import OccError, PluginError
from occ_model.scene.parameters import open_choice
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.line_codes.registry import checked_chips, is_bits

_MODULES = {"paper": "paper", "preamble": "preamble", "c-ook": "c_ook", "raw": "raw"}
"""The file of each built-in framing, imported when the framing is first used."""


def built_in_framings() -> dict[str, Framing]:
    """Return the built-in framings by name."""
    return {name: framing_named(name) for name in _MODULES}


def framings() -> tuple[str, ...]:
    """Return the names of all framings, those of plug-ins last."""
    return open_choice("framing").all_choices()


@lru_cache(maxsize=64)
def framing_named(name: str) -> Framing:
    """Find a framing.

    Raises
    ------
    ParameterError
        There is none of that name.
    PluginError
        It is a plug-in that cannot be used.
    """
    open_choice("framing").check(name)
    if name in _MODULES:
        module = import_module(f"occ_model.transmitter.framings.{_MODULES[name]}")
        built_in: Framing = module.FRAMING
        return built_in
    return _guarded(plugins.load_plugin(plugins.FRAMINGS, name, Framing))


def _guarded(offered: Framing) -> Framing:
    """Return a plug-in's framing whose faults become sentences."""
    who = plugins.described(plugins.FRAMINGS, offered.name)

    def encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
        try:
            chips = np.asarray(offered.encode(bits, form))
        except OccError:  # the line code's own sentence
            raise
        except plugins.FAULTS as error:
            raise PluginError(f"{who} cannot encode: {plugins.reason(error)}") from None
        return checked_chips(chips, who)

    def decode(chips: ByteArray, form: FrameFormat) -> Framed:
        try:
            read = offered.decode(chips, form)
        except plugins.FAULTS as error:
            return Framed.nothing(f"{who} cannot decode: {plugins.reason(error)}")
        if not isinstance(read, Framed) or not is_bits(read.bits):
            return Framed.nothing(f"{who} gives no bits, but a {type(read).__name__}.")
        if read.failure is None and not read.bits.size:
            return Framed.nothing(f"{who} gives neither bits nor a reason.")
        return read

    return replace(offered, encode=encode, decode=decode)
