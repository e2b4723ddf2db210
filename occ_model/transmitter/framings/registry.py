"""The framings by name: the built-in ones and those of plug-ins."""

from dataclasses import replace

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError, PluginError, shown
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.plugin_values import (
    are_places,
    checked_chips,
    excess,
    is_bits,
    is_reason,
    plain_bits,
    plain_reason,
)
from occ_model.transmitter.registry import Registry


def _problem_of(read: object, chips: int, bits: int) -> str | None:
    """Say what is wrong with what a plug-in has read; None if nothing is."""
    if not isinstance(read, Framed):
        return f"no bits, but a {type(read).__name__}"
    if problem := excess("bits", read.bits, bits):
        return problem
    if not is_bits(read.bits):
        return f"no bits, but a {type(read.bits).__name__}"
    if not is_reason(read.failure) or (read.failure is None and not read.bits.size):
        return "neither bits nor a reason"
    if not are_places(read.headers, chips):
        return "headers that are not places among the chips"
    return None


def _guarded(offered: Framing) -> Framing:
    """Return a plug-in's framing whose faults become sentences."""
    who = plugins.described(plugins.FRAMINGS, offered.name)
    if not isinstance(offered.checks, bool):
        raise PluginError(
            f"{who} declares checks = {shown(offered.checks)}; allowed: True or False."
        )

    def encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
        try:
            with plugins.at_work(who):
                chips = np.asarray(offered.encode(bits, form))
        except plugins.FAULTS as error:
            if isinstance(error, PluginError | ParameterError) and str(error).isprintable():
                raise  # the line code's own sentence
            raise PluginError(f"{who} cannot encode: {plugins.reason(error)}") from None
        return checked_chips(chips, who)

    def decode(chips: ByteArray, form: FrameFormat) -> Framed:
        try:
            with plugins.at_work(who):
                read = offered.decode(chips, form)
        except plugins.FAULTS as error:
            return Framed.nothing(f"{who} cannot decode: {plugins.reason(error)}")
        if problem := _problem_of(read, len(chips), form.bits):
            return Framed.nothing(f"{who} gives {problem}.")
        return Framed(read.headers, plain_bits(read.bits), plain_reason(read.failure))

    return replace(offered, title=plugins.title_of(offered), encode=encode, decode=decode)


FRAMINGS = Registry(  # the framings that a scene chooses among
    parameter="framing",
    kind=Framing,
    constant="FRAMING",
    package=__package__,
    files={"paper": "paper", "preamble": "preamble", "c-ook": "c_ook", "raw": "raw"},
    group=plugins.FRAMINGS,
    guarded=_guarded,
)


def framings() -> tuple[str, ...]:
    """Return the names of all framings, those of plug-ins last."""
    return FRAMINGS.names()
