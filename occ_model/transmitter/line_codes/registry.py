"""The line codes by name: the built-in ones and those of plug-ins."""

from dataclasses import replace

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import PluginError, shown
from occ_model.scene.parameter_kinds import MAX_PATTERN_CHIPS
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode
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


def _check_declared(offered: LineCode, who: str) -> None:
    """Refuse a plug-in's line code whose properties are not of their kind."""
    counts = {
        "block_bits": (offered.block_bits, 1),
        "block_chips": (offered.block_chips, 1),
        "longest_run": (1 if offered.longest_run is None else offered.longest_run, 1),
        "disparity": (0 if offered.disparity is None else offered.disparity, 0),
    }
    for label, (count, low) in counts.items():
        if type(count) is not int or not low <= count <= MAX_PATTERN_CHIPS:
            raise PluginError(
                f"{who} declares {label} = {shown(count)}; allowed: {low} to {MAX_PATTERN_CHIPS}."
            )
    preamble: object = offered.preamble
    is_preamble = isinstance(preamble, str) and len(preamble) <= MAX_PATTERN_CHIPS
    if not is_preamble or set(offered.preamble) - {"0", "1"}:
        raise PluginError(f"{who} declares preamble = {shown(preamble)}; allowed: zeros and ones.")
    if not isinstance(offered.finds_wrong_chip, bool):
        raise PluginError(
            f"{who} declares finds_wrong_chip = {shown(offered.finds_wrong_chip)}; allowed: True "
            "or False."
        )


def _guarded(offered: LineCode) -> LineCode:
    """Return a plug-in's line code whose faults become sentences."""
    who = plugins.described(plugins.LINE_CODES, offered.name)
    _check_declared(offered, who)

    def encode(bits: ByteArray, level: int) -> ByteArray:
        try:
            with plugins.at_work(who):
                chips = np.asarray(offered.encode(bits, level))
        except plugins.FAULTS as error:
            raise PluginError(f"{who} cannot encode: {plugins.reason(error)}") from None
        return checked_chips(chips, who, offered.chips_for(len(bits)))

    def decode(chips: ByteArray, level: int) -> Decoded:
        try:
            with plugins.at_work(who):
                read = offered.decode(chips, level)
        except plugins.FAULTS as error:
            return Decoded(failure=f"{who} cannot decode: {plugins.reason(error)}")
        most = (len(chips) // offered.block_chips + 1) * offered.block_bits
        if isinstance(read, Decoded) and (problem := excess("bits", read.bits, most)):
            return Decoded(failure=f"{who} gives {problem}.")
        if not isinstance(read, Decoded) or not is_bits(read.bits):
            return Decoded(failure=f"{who} gives no bits, but a {type(read).__name__}.")
        if not are_places(read.violations, len(read.bits)) or not is_reason(read.failure):
            return Decoded(failure=f"{who} gives bits, but not where they break the code, or why.")
        return Decoded(plain_bits(read.bits), read.violations, plain_reason(read.failure))

    return replace(offered, title=plugins.title_of(offered), encode=encode, decode=decode)


LINE_CODES = Registry(  # the line codes that a scene chooses among
    parameter="line_code",
    kind=LineCode,
    constant="LINE_CODE",
    package=__package__,
    files={
        "differential-manchester": "differential_manchester",
        "manchester": "manchester",
        "nrz": "nrz",
        "4b6b": "four_b_six_b",
        "8b10b": "eight_b_ten_b",
        "fsk": "fsk",
    },
    group=plugins.LINE_CODES,
    guarded=_guarded,
)


def line_codes() -> tuple[str, ...]:
    """Return the names of all line codes, those of plug-ins last."""
    return LINE_CODES.names()
