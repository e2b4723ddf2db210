"""The line codes by name: the built-in ones and those of plug-ins."""

from dataclasses import replace

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError, PluginError, one_line, shown
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode
from occ_model.transmitter.registry import (
    Registry,
    check_kinds,
    check_places,
    checked_bits,
    plain_reason,
)


def _guarded(offered: LineCode) -> LineCode:
    """Return a plug-in's line code whose faults become sentences."""
    who = plugins.described(plugins.LINE_CODES, offered.name)
    run = 1 if offered.longest_run is None else offered.longest_run
    for name, count in (
        ("block_bits", offered.block_bits),
        ("block_chips", offered.block_chips),
        ("longest_run", run),
    ):
        if not isinstance(count, int) or count < 1:
            raise PluginError(f"{who} declares {name} = {shown(count)}; allowed: from 1.")
    preamble: object = offered.preamble
    if not isinstance(preamble, str) or set(preamble) - {"0", "1"}:
        raise PluginError(f"{who} declares preamble = {shown(preamble)}; allowed: zeros and ones.")

    def encode(bits: ByteArray, level: int) -> ByteArray:
        chips = plugins.called(who, "encode", np.ndarray, offered.encode, bits, level)
        count = offered.chips_for(len(bits))
        if chips.size != count:
            raise PluginError(f"{who} gives {chips.size} chips in place of {count}.")
        return checked_bits(who, "chips", chips, count)

    def decode(chips: ByteArray, level: int) -> Decoded:
        most = (len(chips) // offered.block_chips + 1) * offered.block_bits
        try:
            read = plugins.called(who, "decode", Decoded, offered.decode, chips, level)
            check_kinds(who, read, failure=str | None)
            bits = checked_bits(who, "bits", read.bits, most)
            check_places(who, "violations", read.violations, len(bits))
        except (ParameterError, PluginError) as error:
            return Decoded(failure=str(error))
        return Decoded(bits, read.violations, plain_reason(read.failure))

    return replace(offered, title=one_line(str(offered.title)), encode=encode, decode=decode)


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
