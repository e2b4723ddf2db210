"""Plug-ins that raise or give rubbish: each is named in a sentence, and the program lives."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from model.plugins.installed_package import forget_plugins, install

import occ_model as occ
from occ_model import plugins
from occ_model.receiver import decoders

MODULE = """
from dataclasses import replace

import numpy as np

import occ_model as occ
from occ_model.transmitter.framings.preamble import FRAMING
from occ_model.transmitter.line_codes.manchester import LINE_CODE


def fail(*_):
    raise ValueError("not today")


def leave(*_):
    raise SystemExit(3)


def overwrite(signal, scene):
    signal[:] = 0
    return occ.DecodeResult("overwrites", failure="Nothing\\nwas read.")


def decoder(name, read):
    return occ.Decoder(name, name, read)


def spoiled(name, **parts):
    read = occ.DecodeResult(name, code=1, bits=np.array([1]), chips=np.array([1, 0]))
    return decoder(name, lambda *_: replace(read, **parts))


# As many values as nothing could look at one by one.
endless = np.broadcast_to(np.uint8(0), 10**12)
raises = decoder("raises", fail)
leaves = decoder("leaves", leave)
nothing = decoder("nothing", lambda *_: None)
empty = decoder("empty", lambda *_: occ.DecodeResult("empty"))
floats = spoiled("floats", bits=np.array([0.5]))
huge = spoiled("huge", chips=endless)
overwrites = decoder("overwrites", overwrite)
misnamed = decoder("another", fail)
threshold = decoder("threshold", fail)

code_raises = replace(LINE_CODE, name="code_raises", encode=fail, decode=fail)
code_short = replace(LINE_CODE, name="code_short", encode=lambda bits, level: bits)
code_grey = replace(LINE_CODE, name="code_grey", encode=lambda bits, _: np.arange(2 * len(bits)))
code_mute = replace(LINE_CODE, name="code_mute", decode=lambda chips, level: None)

code_scalar = replace(LINE_CODE, name="code_scalar", encode=lambda *_: np.array(1))
code_wordless = replace(
    LINE_CODE, name="code_wordless", decode=lambda *_: occ.Decoded(np.array([1]), failure=3)
)
code_blockless = replace(LINE_CODE, name="code_blockless", block_chips=0)
code_lettered = replace(LINE_CODE, name="code_lettered", preamble="ab")

frame_empty = replace(FRAMING, name="frame_empty", encode=lambda bits, form: np.array([]))
frame_huge = replace(FRAMING, name="frame_huge", encode=lambda *_: endless)
frame_fails = replace(FRAMING, name="frame_fails", decode=fail)
frame_elsewhere = replace(
    FRAMING, name="frame_elsewhere", decode=lambda *_: occ.Framed((-1,), np.array([1]))
)
frame_says_nothing = replace(
    FRAMING, name="frame_says_nothing", decode=lambda *_: occ.Framed((), np.array([]))
)
"""

DECODERS = [
    "raises", "leaves", "nothing", "empty", "floats", "overwrites", "misnamed", "threshold", "gone",
    "huge",
]  # fmt: skip
CODES = [
    "code_raises", "code_short", "code_grey", "code_mute", "code_scalar", "code_wordless",
    "code_blockless", "code_lettered",
]  # fmt: skip
FRAMINGS = ["frame_empty", "frame_huge", "frame_fails", "frame_elsewhere", "frame_says_nothing"]
SCENE = occ.load_preset("phone-68us").replace(rows=100, distance=0.6, switching_frequency=4e3)


def named(names: list[str], module: str = "hostile") -> dict[str, str]:
    return {name: f"{module}:{name}" for name in names}


@pytest.fixture(autouse=True)
def _hostile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Install hostile plug-ins, which no other test sees."""
    groups = {
        plugins.DECODERS: named(DECODERS) | {"broken": "broken_import:DECODER"},
        plugins.LINE_CODES: named(CODES),
        plugins.FRAMINGS: named(FRAMINGS),
    }
    install(tmp_path, "hostile", groups, MODULE)
    (tmp_path / "broken_import.py").write_text("raise SystemExit('no licence')\n")
    monkeypatch.syspath_prepend(tmp_path)
    forget_plugins()
    yield
    forget_plugins()


def decode(decoder: str) -> occ.DecodeResult:
    return occ.decode(occ.column_profile(SCENE), SCENE, decoder)


@pytest.mark.parametrize(
    ("decoder", "said"),
    [
        ("raises", "cannot read: ValueError: not today."),
        ("leaves", "cannot read: SystemExit: 3."),
        ("nothing", "gives a NoneType, not a DecodeResult."),
        ("empty", "gives neither a code with its bits nor a failure."),
        ("floats", "gives bits that are not zeros and ones."),
        ("huge", "gives 1,000,000,000,000 chips; allowed: up to 65,536."),
    ],
)
def test_a_decoder_that_fails_is_named_in_the_failure(decoder: str, said: str) -> None:
    result = decode(decoder)
    assert result.failure == f"The plug-in '{decoder}' of the package 'hostile' {said}"
    assert result.decoder == decoder
    assert result.code is None


@pytest.mark.parametrize(
    ("decoder", "said"),
    [
        ("broken", "cannot be imported: SystemExit: no licence."),
        ("gone", "cannot be imported: AttributeError: "),
        ("misnamed", "calls itself 'another'."),
    ],
)
def test_a_decoder_that_is_none_is_refused_by_name(decoder: str, said: str) -> None:
    with pytest.raises(occ.PluginError) as caught:
        decode(decoder)
    expected = f"The plug-in '{decoder}' of the package 'hostile' {said}"
    assert str(caught.value).startswith(expected)


def test_a_decoder_cannot_change_the_signal_of_others() -> None:
    signal = occ.column_profile(SCENE)
    before = signal.copy()
    read = decoders.decoder_named("overwrites").read
    assert read(signal, SCENE).failure == r"Nothing\nwas read."
    np.testing.assert_array_equal(signal, before)


def test_a_plugin_does_not_replace_a_built_in_decoder() -> None:
    assert occ.decoders().count("threshold") == 1
    assert decode("threshold").code == SCENE.transmitter.code


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("code_raises", "cannot encode: ValueError: not today."),
        ("code_short", "gives 10 chips in place of 20."),
        ("code_scalar", "gives 1 chips in place of 20."),
        ("code_blockless", "declares block_chips = 0; allowed: from 1."),
        ("code_lettered", "declares preamble = 'ab'; allowed: zeros and ones."),
        ("code_grey", "gives chips that are not zeros and ones."),
    ],
)
def test_a_line_code_that_cannot_be_sent_is_named(name: str, said: str) -> None:
    scene = SCENE.replace(line_code=name)
    with pytest.raises(occ.PluginError) as caught:
        occ.packet(scene)
    assert str(caught.value) == f"The plug-in '{name}' of the package 'hostile' {said}"


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("frame_empty", "gives no chips."),
        ("frame_huge", "gives 1,000,000,000,000 chips; allowed: up to 65,536."),
    ],
)
def test_a_framing_that_cannot_be_sent_is_named(name: str, said: str) -> None:
    with pytest.raises(occ.PluginError) as caught:
        occ.render(SCENE.replace(framing=name))
    assert str(caught.value) == f"The plug-in '{name}' of the package 'hostile' {said}"


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"line_code": "code_mute"}, "gives a NoneType, not a Decoded."),
        ({"line_code": "code_wordless"}, "gives failure = 3 of the type int."),
        ({"framing": "frame_says_nothing"}, "gives neither bits nor a failure."),
        ({"framing": "frame_elsewhere"}, "gives headers that are not places among 111."),
        ({"framing": "frame_fails"}, "cannot decode: ValueError: not today."),
    ],
)
def test_what_cannot_be_read_is_named_in_the_failure(changes: dict[str, str], said: str) -> None:
    scene = SCENE.replace(**changes, enhancement="none")
    result = occ.decode(occ.column_profile(scene), scene)
    name = next(iter(changes.values()))
    assert result.failure == f"The plug-in '{name}' of the package 'hostile' {said}"


def test_a_scene_with_an_unknown_plugin_lists_those_there_are() -> None:
    with pytest.raises(occ.ParameterError, match=r"line_code is 'mine'; allowed: .*code_grey"):
        SCENE.replace(line_code="mine")
    text = SCENE.replace(line_code="code_mute").to_toml()
    assert occ.Scene.from_toml(text).transmitter.line_code == "code_mute"
    with pytest.raises(occ.ParameterError, match="'mine'"):
        occ.Scene.from_toml(text.replace("code_mute", "mine"))
