"""Line codes and framings by name: built-in ones, and those of plug-ins, which are checked."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from importlib import import_module
from typing import Generic, TypeVar

import numpy as np

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import PluginError
from occ_model.scene.parameters import open_choice
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode

_Kind = TypeVar("_Kind")


@dataclass(frozen=True, eq=False)
class Registry(Generic[_Kind]):
    """The objects among which a parameter chooses; each is imported when first needed."""

    parameter: str  # The parameter, whose declaration names the built-in ones
    kind: type[_Kind]
    constant: str  # Name in a module of the object that it offers
    package: str  # Folder of the built-in ones, in files by name: c_ook.py, _4b6b.py
    group: str  # The plug-ins' entry point
    guard: Callable[[_Kind], _Kind]  # Wraps a plug-in's object so that its faults become sentences

    def names(self) -> tuple[str, ...]:
        """Return all names, those of plug-ins last."""
        return open_choice(self.parameter).all_choices()

    def is_built_in(self, name: str) -> bool:
        return name in open_choice(self.parameter).choices

    def load_built_in(self) -> dict[str, _Kind]:
        return {name: self.get(name) for name in open_choice(self.parameter).choices}

    @cache  # noqa: B019 - the registries live as long as the program, and names are few
    def get(self, name: str) -> _Kind:
        open_choice(self.parameter).check(name)
        if self.is_built_in(name):
            file = ("_" if name[0].isdigit() else "") + name.replace("-", "_")
            built_in: _Kind = getattr(import_module(f"{self.package}.{file}"), self.constant)
            return built_in
        return self.guard(plugins.load_plugin(self.group, name, self.kind))


def require_bits(who: str, what: str, values: object) -> ByteArray:
    """Return a plug-in's zeros and ones as bytes, in an array that it cannot change later."""
    array = np.asarray(values)
    if array.ndim != 1 or not np.isin(array, (0, 1)).all():
        raise PluginError(f"{who} gives {what} that are not an array of zeros and ones.")
    return array.astype(np.uint8)


def _guard_line_code(offered: LineCode) -> LineCode:
    """Wrap a plug-in's line code so that its faults become sentences."""
    who = plugins.describe(plugins.LINE_CODES, offered.name)

    def encode(bits: ByteArray, level: int) -> ByteArray:
        count = offered.chips_for(len(bits))

        def check(chips: object) -> ByteArray:
            array = require_bits(who, "chips", chips)
            if len(array) != count:
                raise PluginError(f"{who} gives {len(array)} chips in place of {count}.")
            return array

        return plugins.call(who, "encode", check, offered.encode, bits.copy(), level)

    def decode(chips: ByteArray, level: int) -> Decoded:
        blocks, rest = divmod(len(chips), offered.block_chips)

        def check(read: object) -> Decoded:
            read = plugins.of_kind(who, Decoded)(read)
            bits = require_bits(who, "bits", read.bits)
            if read.failure is None and rest == 0 and len(bits) != blocks * offered.block_bits:
                raise PluginError(
                    f"{who} gives {len(bits)} bits in place of {blocks * offered.block_bits}."
                )
            return replace(read, bits=bits)

        return plugins.call(who, "decode", check, offered.decode, chips.copy(), level)

    return replace(offered, encode=encode, decode=decode)


LINE_CODES = Registry(  # the line codes among which a scene chooses
    parameter="line_code",
    kind=LineCode,
    constant="LINE_CODE",
    package="occ_model.transmitter.line_codes",
    group=plugins.LINE_CODES,
    guard=_guard_line_code,
)


def line_codes() -> tuple[str, ...]:
    """Return the names of all line codes, those of plug-ins last."""
    return LINE_CODES.names()


def _guard_framing(offered: Framing) -> Framing:
    """Wrap a plug-in's framing so that its faults become sentences."""
    who = plugins.describe(plugins.FRAMINGS, offered.name)

    lengths: dict[tuple[str, str, int], int] = {}

    def encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
        def check(chips: object) -> ByteArray:
            array = require_bits(who, "chips", chips)
            # Every payload must have the same number of chips, on which its readers rely.
            key = form.line_code.name, form.preamble, form.bits
            length = lengths.setdefault(key, len(array))
            if not array.size:
                raise PluginError(f"{who} gives no chips.")
            if len(array) != length:
                raise PluginError(
                    f"{who} gives {len(array)} chips for one payload, {length} for another."
                )
            return array

        return plugins.call(who, "encode", check, offered.encode, bits.copy(), form)

    def decode(chips: ByteArray, form: FrameFormat) -> Framed:
        def check(read: object) -> Framed:
            read = plugins.of_kind(who, Framed)(read)
            bits = require_bits(who, "bits", read.bits)
            if read.failure is None and len(bits) != form.bits:
                raise PluginError(
                    f"{who} gives {len(bits)} bits in place of {form.bits}, and no failure."
                )
            return replace(read, bits=bits)

        return plugins.call(who, "decode", check, offered.decode, chips.copy(), form)

    return replace(offered, encode=encode, decode=decode)


FRAMINGS = Registry(  # the framings among which a scene chooses
    parameter="framing",
    kind=Framing,
    constant="FRAMING",
    package="occ_model.transmitter.framings",
    group=plugins.FRAMINGS,
    guard=_guard_framing,
)


def framings() -> tuple[str, ...]:
    """Return the names of all framings, those of plug-ins last."""
    return FRAMINGS.names()
