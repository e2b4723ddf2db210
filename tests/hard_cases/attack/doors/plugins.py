"""Plug-ins that raise anything or give anything, under any name."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import fields, replace
from pathlib import Path
from random import Random

import numpy as np
from model.plugins.installed_package import forget_plugins, install

import occ_model as occ
from hard_cases.attack import chance as made
from hard_cases.attack.promise import Door, check_sentence
from occ_model import plugins
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.framings.preamble import FRAMING
from occ_model.transmitter.line_codes.line_code import Decoded
from occ_model.transmitter.line_codes.manchester import LINE_CODE

_PACKAGE = "hostile"
_MODULE = f"from {__name__} import offered as __getattr__\n"

_NAMES = ("mine", "a b", "é", "\u202e", "x" * 300, "threshold", "manchester", "-", "[x", "1", "a:b")
"""Names of plug-ins; what cannot be written as one is left out by the reader."""


class UnspeakableError(Exception):
    """An exception that cannot say what it is."""

    def __str__(self) -> str:
        raise RuntimeError


_FAULTS: tuple[BaseException, ...] = (
    ValueError("not\ntoday"), SystemExit(3), UnspeakableError(), MemoryError(),
    RecursionError("deep"), KeyError("k" * 9000), StopIteration(), OSError(5, "\x1b[31m"),
    occ.OccError("A sentence."), occ.ParameterError("Two\nlines."),
    AssertionError(), UserWarning("w"),
)  # fmt: skip

_made: Random = Random(0)


def offered(name: str) -> object:
    """Make what a hostile package has under a name; each asking makes another."""
    if name.startswith("__"):
        raise AttributeError(name)
    if _made.random() < 0.1:
        raise _made.choice(_FAULTS)
    if _made.random() < 0.1:
        return _nonsense()
    if name == "decoder":
        return _decoder()
    return _coder(_CODERS[name], name)


def _nonsense() -> object:
    """Any object, arrays of wrong kinds and shapes among them."""
    arrays: tuple[object, ...] = (
        np.array([]), np.array([0.5, np.nan]), np.zeros((2, 2), dtype=np.uint8), np.array(["1"]),
        np.array([0, 1], dtype=object), np.array([[None]]), np.array(1), np.full(20, 7),
        np.array([True, False]), np.array([1, -1]), np.ones(10**6, dtype=np.uint8), [1, 0], "1010",
        np.array([0, 1, 1], dtype=np.uint8), np.array([np.inf]), np.ma.masked_array([1, 0]),
        DecodeResult("x"), Decoded(), Framed((), np.array([1])), LINE_CODE, FRAMING,
    )  # fmt: skip
    return _made.choice(arrays) if _made.random() < 0.6 else made.value(_made)


def _does(right: Callable[..., object]) -> Callable[..., object]:
    """A function that raises, or gives nonsense, or what it should."""

    def call(*arguments: object) -> object:
        kind = _made.random()
        if kind < 0.2:
            raise _made.choice(_FAULTS)
        return _nonsense() if kind < 0.5 else right(*arguments)

    return call


def _named(name: str) -> object:
    return name if _made.random() < 0.9 else _nonsense()


def _spoiled(whole: object, right: tuple[str, ...]) -> object:
    """A result, some of whose fields are nonsense."""
    names = [each.name for each in fields(whole) if each.name not in right]  # type: ignore[arg-type]
    some = _made.sample(names, _made.choice((0, 0, 1, 2)))
    return replace(whole, **{name: _nonsense() for name in some})  # type: ignore[type-var]


def _decoder() -> object:
    def read(signal: np.ndarray, scene: Scene) -> object:
        own = occ.decode(signal, scene, "threshold")
        whole = replace(own, code=3, bits=np.array([0, 1, 1], np.uint8), failure=None)
        return _spoiled(replace(_made.choice((own, whole)), decoder=_own_name("decoder")), ())

    return occ.Decoder(_named(_own_name("decoder")), _named("A title"), _does(read))  # type: ignore[arg-type]


_CODERS: dict[str, occ.LineCode | occ.Framing] = {"code": LINE_CODE, "frame": FRAMING}


def _coder(offered: occ.LineCode | occ.Framing, kind: str) -> object:
    """Give a line code or a framing that does and declares what chance makes of a right one."""
    made = replace(
        offered,
        name=_own_name(kind),
        encode=_does(offered.encode),  # type: ignore[arg-type]
        decode=_does(offered.decode),  # type: ignore[arg-type]
    )
    return _spoiled(made, ("name", "encode", "decode"))


_names: dict[str, str] = {}


def _own_name(kind: str) -> str:
    return _names[kind]


@contextmanager
def _installed(chance: Random, folder: Path) -> Iterator[None]:
    """Install a package whose decoder, line code and framing are made by chance."""
    global _made
    _made = chance
    for kind in ("decoder", "code", "frame"):
        _names[kind] = chance.choice(_NAMES) if chance.random() < 0.4 else f"own-{kind}"
    groups = {
        plugins.DECODERS: {_names["decoder"]: f"{_PACKAGE}:decoder"},
        plugins.LINE_CODES: {_names["code"]: f"{_PACKAGE}:code"},
        plugins.FRAMINGS: {_names["frame"]: f"{_PACKAGE}:frame"},
    }
    install(folder, _PACKAGE, groups, _MODULE)
    sys.path.insert(0, str(folder))
    forget_plugins()
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        sys.modules.pop(_PACKAGE, None)
        forget_plugins()


def check_result(result: DecodeResult) -> list[str]:
    """See that all of a decoder's result is of its kind, and give its failure."""
    assert isinstance(result, DecodeResult)
    for values in (result.bits, result.chips):
        assert values.ndim == 1
        assert np.isin(values, (0, 1)).all()
    assert isinstance(result.payload, str)
    assert isinstance(result.decoder, str)
    for share in (result.confidence, result.correlation, result.chip_length, result.threshold):
        assert share is None or np.isfinite(share)
    if result.failure is None:
        assert isinstance(result.code, int)
        assert result.code >= 0
        assert result.bits.size
        return []
    check_sentence(result.failure)
    return [result.failure]


SCENE = occ.load_preset("phone-68us").replace(
    rows=20, distance=0.6, switching_frequency=4e3, enhancement="none"
)


def _decoded(_chance: Random, _folder: Path) -> list[str]:
    return check_result(occ.decode(occ.column_profile(SCENE), SCENE, _names["decoder"]))


def _sent(chance: Random, _folder: Path) -> list[str]:
    changes = chance.choice((
        {"line_code": _names["code"]},
        {"framing": _names["frame"]},
        {"line_code": _names["code"], "framing": _names["frame"]},
    ))  # fmt: skip
    scene = SCENE.replace(**changes)
    assert Scene.from_toml(scene.to_toml()) == scene
    chips = occ.packet(scene)
    assert chips.dtype == np.uint8
    assert np.isin(chips, (0, 1)).all()
    return check_result(
        occ.decode(occ.column_profile(scene), scene, chance.choice(["threshold", "sequence"]))
    )


def _studied(chance: Random, _folder: Path) -> list[str]:
    rate = occ.success_rate(SCENE, images=2, decoder=_names["decoder"])
    assert 0.0 <= rate <= 100.0
    return []


def _in_the_shell(chance: Random, folder: Path) -> list[str]:
    from hard_cases.attack.doors.shell import ended, messages
    from occ_model.cli import main

    path = folder / "scene.toml"
    path.write_text(SCENE.to_toml(), "utf-8")
    words = chance.choice((
        ["codes"],
        ["sweep", "--scene", str(path), "--vary=distance=0.6,1", "--images=1",
         f"--decoder={_names['decoder']}"],
        ["plan", "--scene", str(path), f"--set=line_code={_names['code']}"],
        ["limits", "--scene", str(path), f"--decoder={_names['decoder']}", "--images=1",
         "--jobs=1"],
        ["transmit", "--scene", str(path), f"--set=framing={_names['frame']}", "-o", f"{folder}/x"],
    ))  # fmt: skip
    code, out, err = ended(main, words)
    try:
        return messages(code, out, err)
    except AssertionError as fault:
        raise AssertionError(f"{words} -> {code}: {fault}") from None


_WAYS = (_decoded, _decoded, _sent, _sent, _studied, _in_the_shell)


def _plugin(chance: Random, folder: Path) -> list[str]:
    with _installed(chance, folder):
        return chance.choice(_WAYS)(chance, folder)


PLUGINS = Door(
    "plug-ins", "decoders, line codes, framings that raise or give anything", _plugin,
    (occ.PluginError, occ.ParameterError), share=60,
)  # fmt: skip
