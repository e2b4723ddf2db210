"""The framings by name: the built-in ones and those of plug-ins."""

from dataclasses import replace

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError, PluginError, one_line
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.registry import (
    MOST_CHIPS,
    Registry,
    check_kinds,
    check_places,
    checked_bits,
    plain_reason,
)


def _guarded(offered: Framing) -> Framing:
    """Return a plug-in's framing whose faults become sentences."""
    who = plugins.described(plugins.FRAMINGS, offered.name)

    def encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
        chips = plugins.called(who, "encode", np.ndarray, offered.encode, bits, form)
        if not chips.size:
            raise PluginError(f"{who} gives no chips.")
        return checked_bits(who, "chips", chips, MOST_CHIPS)

    def decode(chips: ByteArray, form: FrameFormat) -> Framed:
        try:
            read = plugins.called(who, "decode", Framed, offered.decode, chips, form)
            check_kinds(who, read, failure=str | None)
            bits = checked_bits(who, "bits", read.bits, form.bits)
            check_places(who, "headers", read.headers, len(chips))
            if not read.failure and not bits.size:
                raise PluginError(f"{who} gives neither bits nor a failure.")
        except (ParameterError, PluginError) as error:
            return Framed.nothing(str(error))
        return Framed(read.headers, bits, plain_reason(read.failure))

    return replace(offered, title=one_line(str(offered.title)), encode=encode, decode=decode)


FRAMINGS = Registry(  # the framings that a scene chooses among
    parameter="framing",
    kind=Framing,
    constant="FRAMING",
    package=__package__,
    group=plugins.FRAMINGS,
    guarded=_guarded,
)


def framings() -> tuple[str, ...]:
    """Return the names of all framings, those of plug-ins last."""
    return FRAMINGS.names()
