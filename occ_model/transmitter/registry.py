"""Line codes and framings by name: built-in ones, and those of plug-ins, which are checked."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from importlib import import_module
from typing import Generic, TypeVar

from occ_model import plugins
from occ_model.arrays import ByteArray
from occ_model.errors import PluginError, quote
from occ_model.scene.parameters import open_choice
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode
from occ_model.transmitter.plugin_checks import (
    require_bits,
    require_count,
    require_failure,
    require_places,
    require_text,
)

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


MOST_CHIPS = 65_536  # in a plug-in's period or result; the longest built-in packet has 57,116


def _guard_line_code(offered: LineCode) -> LineCode:
    """Wrap a plug-in's line code so that its faults become sentences."""
    who = plugins.describe(plugins.LINE_CODES, offered.name)

    def check_declaration(code: LineCode) -> LineCode:
        preamble = require_text(who, "preamble", code.preamble)
        if set(preamble) - {"0", "1"}:
            raise PluginError(f"{who} gives preamble = {quote(preamble)}; allowed: zeros and ones.")
        run, disparity = code.longest_run, code.disparity
        return LineCode(
            code.name,
            require_text(who, "title", code.title),
            require_count(who, "block_bits", code.block_bits, 1, MOST_CHIPS),
            require_count(who, "block_chips", code.block_chips, 1, MOST_CHIPS),
            None if run is None else require_count(who, "longest_run", run, 1, MOST_CHIPS),
            None
            if disparity is None
            else require_count(who, "disparity", disparity, 0, MOST_CHIPS),
            bool(code.finds_wrong_chip),
            code.encode,
            code.decode,
            preamble,
        )

    checked_code = plugins.call(who, "be used", check_declaration, lambda: offered)

    def encode(bits: ByteArray, level: int) -> ByteArray:
        count = checked_code.chips_for(len(bits))

        def check(chips: object) -> ByteArray:
            array = require_bits(who, "chips", chips, MOST_CHIPS)
            if len(array) != count:
                raise PluginError(f"{who} gives {len(array)} chips in place of {count}.")
            return array

        return plugins.call(who, "encode", check, checked_code.encode, bits.copy(), level)

    def decode(chips: ByteArray, level: int) -> Decoded:
        blocks, rest = divmod(len(chips), checked_code.block_chips)
        most = (blocks + 1) * checked_code.block_bits

        def check(read: object) -> Decoded:
            read = plugins.of_kind(who, Decoded)(read)
            failure = require_failure(who, read.failure)
            bits = require_bits(who, "bits", read.bits, most)
            if failure is None and rest == 0 and len(bits) != blocks * checked_code.block_bits:
                raise PluginError(
                    f"{who} gives {len(bits)} bits in place of {blocks * checked_code.block_bits}."
                )
            places = require_places(who, "violations", read.violations, len(bits))
            return Decoded(bits, places, failure)

        return plugins.call(who, "decode", check, checked_code.decode, chips.copy(), level)

    return replace(checked_code, encode=encode, decode=decode)


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

    def check_declaration(framing: Framing) -> Framing:
        title = require_text(who, "title", framing.title)
        return Framing(framing.name, title, bool(framing.checks), framing.encode, framing.decode)

    checked_framing = plugins.call(who, "be used", check_declaration, lambda: offered)
    lengths: dict[tuple[str, str, int], int] = {}

    def encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
        def check(chips: object) -> ByteArray:
            array = require_bits(who, "chips", chips, MOST_CHIPS)
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

        return plugins.call(who, "encode", check, checked_framing.encode, bits.copy(), form)

    def decode(chips: ByteArray, form: FrameFormat) -> Framed:
        def check(read: object) -> Framed:
            read = plugins.of_kind(who, Framed)(read)
            failure = require_failure(who, read.failure)
            bits = require_bits(who, "bits", read.bits, form.bits)
            if failure is None and len(bits) != form.bits:
                raise PluginError(
                    f"{who} gives {len(bits)} bits in place of {form.bits}, and no failure."
                )
            return Framed(require_places(who, "headers", read.headers, len(chips)), bits, failure)

        return plugins.call(who, "decode", check, checked_framing.decode, chips.copy(), form)

    return replace(checked_framing, encode=encode, decode=decode)


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
