"""The line codes by name: the built-in ones and those of plug-ins."""

from dataclasses import replace

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import PluginError, shown
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode
from occ_model.transmitter.registry import Registry


def _guarded(offered: LineCode) -> LineCode:
    """Return a plug-in's line code whose faults become sentences."""
    who = plugins.described(plugins.LINE_CODES, offered.name)
    longest = 1 if offered.longest_run is None else offered.longest_run
    for label, count in (
        ("block_bits", offered.block_bits),
        ("block_chips", offered.block_chips),
        ("longest_run", longest),
    ):
        if not isinstance(count, int) or count < 1:
            raise PluginError(f"{who} declares {label} = {shown(count)}; allowed: from 1.")
    if not isinstance(offered.preamble, str) or set(offered.preamble) - {"0", "1"}:
        raise PluginError(
            f"{who} declares preamble = {shown(offered.preamble)}; allowed: zeros and ones."
        )

    def encode(bits: ByteArray, level: int) -> ByteArray:
        try:
            chips = np.asarray(offered.encode(bits, level))
        except plugins.FAULTS as error:
            raise PluginError(f"{who} cannot encode: {plugins.reason(error)}") from None
        return checked_chips(chips, who, offered.chips_for(len(bits)))

    def decode(chips: ByteArray, level: int) -> Decoded:
        try:
            read = offered.decode(chips, level)
        except plugins.FAULTS as error:
            return Decoded(failure=f"{who} cannot decode: {plugins.reason(error)}")
        if not isinstance(read, Decoded) or not is_bits(read.bits):
            return Decoded(failure=f"{who} gives no bits, but a {type(read).__name__}.")
        return read

    return replace(offered, encode=encode, decode=decode)


def is_bits(values: object) -> bool:
    """Whether values are an array of zeros and ones of one dimension."""
    return (
        isinstance(values, np.ndarray)
        and values.ndim == 1
        and values.dtype.kind in "biu"
        and bool(np.isin(values, (0, 1)).all())
    )


def checked_chips(chips: object, who: str, count: int | None = None) -> ByteArray:
    """Return a plug-in's chips as bytes.

    Raises
    ------
    PluginError
        They are no zeros and ones, or not as many as they should be.
    """
    if not isinstance(chips, np.ndarray) or not is_bits(chips) or not chips.size:
        raise PluginError(f"{who} gives no chips, which are zeros and ones.")
    if count is not None and len(chips) != count:
        raise PluginError(f"{who} gives {len(chips)} chips in place of {count}.")
    return chips.astype(np.uint8)


LINE_CODES = Registry(
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
"""The line codes that a scene chooses among."""


def line_codes() -> tuple[str, ...]:
    """Return the names of all line codes, those of plug-ins last."""
    return LINE_CODES.names()
