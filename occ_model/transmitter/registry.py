"""Line codes and framings by name: the built-in ones, and those of plug-ins, which are checked."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from importlib import import_module
from numbers import Integral
from typing import Any, Generic, TypeVar

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError, PluginError, one_line, shown
from occ_model.scene.parameters import open_choice
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode

_Kind = TypeVar("_Kind")


@dataclass(frozen=True, eq=False)
class Registry(Generic[_Kind]):
    """The objects that a parameter chooses among, each imported when first needed."""

    parameter: str  # The parameter, which declares the names of the built-in ones
    kind: type[_Kind]
    constant: str  # What a module calls the object that it offers
    package: str  # The folder of the built-in ones, each in its name's file: c_ook.py, _4b6b.py
    group: str  # The entry point of the plug-ins
    guarded: Callable[[_Kind], _Kind]  # Turns the faults of a plug-in's object into sentences

    def names(self) -> tuple[str, ...]:
        """Return all names, those of plug-ins last."""
        return open_choice(self.parameter).all_choices()

    def is_built_in(self, name: str) -> bool:
        return name in open_choice(self.parameter).choices

    def built_in(self) -> dict[str, _Kind]:
        return {name: self.named(name) for name in open_choice(self.parameter).choices}

    @cache  # noqa: B019 - the registries live as long as the program, and names are few
    def named(self, name: str) -> _Kind:
        open_choice(self.parameter).check(name)
        if self.is_built_in(name):
            file = ("_" if name[0].isdigit() else "") + name.replace("-", "_")
            built_in: _Kind = getattr(import_module(f"{self.package}.{file}"), self.constant)
            return built_in
        return self.guarded(plugins.load_plugin(self.group, name, self.kind))


MOST_CHIPS = 65_536  # of a plug-in's period or result: more than any built-in packet has (57,116)


def check_kinds(who: str, given: object, **kinds: Any) -> None:
    """Refuse a plug-in's object if one of its parts, by name, is of another kind."""
    for name, kind in kinds.items():
        value = getattr(given, name)
        if not isinstance(value, kind):
            raise PluginError(
                f"{who} gives {name} = {shown(value)} of the type {type(value).__name__}."
            )


def check_places(who: str, what: str, places: object, count: int) -> None:
    """Refuse places that are not a tuple of whole numbers from 0 to before a count."""
    if not isinstance(places, tuple) or not all(
        isinstance(place, Integral) and 0 <= int(place) < count for place in places
    ):
        raise PluginError(f"{who} gives {what} that are not places among {count:,}.")


def checked_bits(who: str, what: str, values: object, most: int) -> ByteArray:
    """Return a plug-in's bits or chips as bytes, which it cannot change later."""
    if not isinstance(values, np.ndarray) or values.ndim != 1:
        raise PluginError(f"{who} gives {what} that are not an array of one dimension.")
    if len(values) > most:
        raise PluginError(f"{who} gives {len(values):,} {what}; allowed: up to {most:,}.")
    if values.dtype.kind not in "biuf" or not np.isin(values, (0, 1)).all():
        raise PluginError(f"{who} gives {what} that are not zeros and ones.")
    return np.array(values, dtype=np.uint8)


def plain_reason(failure: str | None) -> str | None:
    return one_line(failure) if failure else None


def _guarded_code(offered: LineCode) -> LineCode:
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
    package="occ_model.transmitter.line_codes",
    group=plugins.LINE_CODES,
    guarded=_guarded_code,
)


def line_codes() -> tuple[str, ...]:
    """Return the names of all line codes, those of plug-ins last."""
    return LINE_CODES.names()


def _guarded_framing(offered: Framing) -> Framing:
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
    package="occ_model.transmitter.framings",
    group=plugins.FRAMINGS,
    guarded=_guarded_framing,
)


def framings() -> tuple[str, ...]:
    """Return the names of all framings, those of plug-ins last."""
    return FRAMINGS.names()
