"""The line codes by name: the built-in ones and those of plug-ins."""

from dataclasses import replace

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import PluginError
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode
from occ_model.transmitter.plugin_values import checked_bits, plain_reason
from occ_model.transmitter.registry import Registry


def _guarded(offered: LineCode) -> LineCode:
    """Return a plug-in's line code whose faults become sentences."""
    who = plugins.described(plugins.LINE_CODES, offered.name)

    def encode(bits: ByteArray, level: int) -> ByteArray:
        chips = plugins.called(who, "encode", np.ndarray, offered.encode, bits, level)
        count = offered.chips_for(len(bits))
        if len(chips) != count:
            raise PluginError(f"{who} gives {len(chips)} chips in place of {count}.")
        return checked_bits(who, "chips", chips, count)

    def decode(chips: ByteArray, level: int) -> Decoded:
        most = (len(chips) // offered.block_chips + 1) * offered.block_bits
        try:
            read = plugins.called(who, "decode", Decoded, offered.decode, chips, level)
            bits = checked_bits(who, "bits", read.bits, most)
        except PluginError as error:
            return Decoded(failure=str(error))
        return Decoded(bits, read.violations, plain_reason(read.failure))

    return replace(offered, encode=encode, decode=decode)


LINE_CODES = Registry(  # the line codes that a scene chooses among
    parameter="line_code",
    kind=LineCode,
    constant="LINE_CODE",
    package=__package__,
    group=plugins.LINE_CODES,
    guarded=_guarded,
)


def line_codes() -> tuple[str, ...]:
    """Return the names of all line codes, those of plug-ins last."""
    return LINE_CODES.names()
