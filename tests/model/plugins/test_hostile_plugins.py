"""Plug-ins that raise or give rubbish: each is named in a sentence, and the program lives."""

from collections.abc import Iterator
from importlib.metadata import EntryPoint
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
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.framings.preamble import FRAMING
from occ_model.transmitter.line_codes.line_code import Decoded
from occ_model.transmitter.line_codes.manchester import LINE_CODE


def fail(*_):
    raise ValueError("not today")


def leave(*_):
    raise SystemExit(3)


def overwrite(signal, scene):
    signal[:] = 0
    return occ.DecodeResult("overwrites", failure="Nothing was read.")


def decoder(name, read):
    return occ.Decoder(name, name, read)


raises = decoder("raises", fail)
leaves = decoder("leaves", leave)
nothing = decoder("nothing", lambda *_: None)
empty = decoder("empty", lambda *_: occ.DecodeResult("empty"))
floats = decoder("floats", lambda *_: occ.DecodeResult("floats", code=1, bits=np.array([0.5])))
lists = decoder("lists", lambda *_: occ.DecodeResult("lists", code=1, bits=[1]))
no_sentence = decoder("no_sentence", lambda *_: occ.DecodeResult("no_sentence", failure=5))
overwrites = decoder("overwrites", overwrite)


def spoiled(name, **parts):
    read = occ.DecodeResult(name, code=1, bits=np.array([1]), chips=np.array([1, 0]))
    return decoder(name, lambda *_: replace(read, **parts))


worded = spoiled("worded", correlation="high")
coded = spoiled("coded", code="7")
placed = spoiled("placed", headers=(2,))
paired = spoiled("paired", chip_starts=np.array([1.0]))
# As many values as nothing could look at one by one.
endless = np.broadcast_to(np.uint8(0), 10**12)
huge_bits = spoiled("huge_bits", bits=endless)
huge_chips = spoiled("huge_chips", chips=endless)
huge_model = spoiled("huge_model", model=endless)
huge_headers = spoiled("huge_headers", headers=(0,) * 10**6)
huge_code = spoiled("huge_code", code=1 << 10**7)
huge_payload = spoiled("huge_payload", payload="x" * 10**7)
wordy = decoder("wordy", lambda *_: occ.DecodeResult("wordy", failure="Two\\nlines."))
curt = decoder("curt", lambda *_: occ.DecodeResult("curt", failure="dark"))
misnamed = decoder("another", fail)
threshold = decoder("threshold", fail)

code_raises = replace(LINE_CODE, name="code_raises", encode=fail, decode=fail)
code_short = replace(LINE_CODE, name="code_short", encode=lambda bits, level: bits)
code_grey = replace(LINE_CODE, name="code_grey", encode=lambda bits, _: np.full(2 * len(bits), 7))
code_blocks = replace(LINE_CODE, name="code_blocks", block_chips=0)
code_run = replace(LINE_CODE, name="code_run", longest_run="two")
code_preamble = replace(LINE_CODE, name="code_preamble", preamble="012")
code_array = replace(LINE_CODE, name="code_array", disparity=np.array([[1], [2]]))
code_maybe = replace(LINE_CODE, name="code_maybe", finds_wrong_chip=None)
code_huge = replace(LINE_CODE, name="code_huge", encode=lambda *_: endless)
code_flood = replace(LINE_CODE, name="code_flood", decode=lambda *_: Decoded(endless))
code_mute = replace(LINE_CODE, name="code_mute", decode=lambda chips, level: None)

frame_raises = replace(FRAMING, name="frame_raises", encode=fail)
frame_empty = replace(FRAMING, name="frame_empty", encode=lambda bits, form: np.array([]))
frame_mute = replace(FRAMING, name="frame_mute", decode=lambda chips, form: "nothing")
frame_fails = replace(FRAMING, name="frame_fails", decode=fail)
frame_placed = replace(
    FRAMING, name="frame_placed", decode=lambda chips, form: Framed((0, len(chips)), np.array([1]))
)
frame_huge = replace(FRAMING, name="frame_huge", encode=lambda *_: endless)
frame_flood = replace(FRAMING, name="frame_flood", decode=lambda *_: Framed((), endless))
frame_checks = replace(FRAMING, name="frame_checks", checks=np.array([]))


def two_lines(*_):
    raise occ.ParameterError("Two\\nlines.")


frame_lines = replace(FRAMING, name="frame_lines", encode=two_lines)
"""

DECODERS = [
    "raises", "leaves", "nothing", "empty", "floats", "lists", "no_sentence", "overwrites",
    "misnamed", "threshold", "gone", "worded", "coded", "placed", "paired", "wordy", "curt",
    "huge_bits", "huge_chips", "huge_model", "huge_headers", "huge_code", "huge_payload",
]  # fmt: skip
CODES = [
    "code_raises", "code_short", "code_grey", "code_blocks", "code_run", "code_preamble",
    "code_mute", "code_array", "code_maybe", "code_huge", "code_flood",
]  # fmt: skip
FRAMINGS = [
    "frame_raises",
    "frame_empty",
    "frame_mute",
    "frame_fails",
    "frame_placed",
    "frame_checks",
    "frame_lines",
    "frame_huge",
    "frame_flood",
]
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
        ("raises", "fails: ValueError: not today."),
        ("leaves", "fails: SystemExit: 3."),
        ("nothing", "gives no DecodeResult but a NoneType."),
        ("empty", "gives neither a code with its bits nor a failure."),
        ("floats", "gives bits that are not an array of zeros and ones."),
        ("lists", "gives bits that are not an array of zeros and ones."),
        ("no_sentence", "gives a failure that is not a sentence."),
        ("worded", "gives correlation = 'high', which is not a number."),
        ("coded", "gives the code '7', which is not a whole number from 0."),
        ("placed", "gives the headers (2,), which are not places among its chips."),
        ("paired", "gives chip_starts that is not an array of as many numbers as it should."),
        ("huge_bits", "gives 1,000,000,000,000 bits; allowed: up to 4,096."),
        ("huge_chips", "gives 1,000,000,000,000 chips; allowed: up to 65,536."),
        ("huge_model", "gives 1,000,000,000,000 levels of the model; allowed: up to 65,536."),
        ("huge_headers", "gives 1,000,000 headers; allowed: up to 65,536."),
        ("huge_code", "gives a code of more than 4,096 bits."),
        ("huge_payload", "gives 10,000,000 letters of a payload; allowed: up to 16,384."),
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


def test_the_failure_of_a_plug_in_is_one_line_with_an_end() -> None:
    assert decode("wordy").failure == r"Two\nlines."
    assert decode("curt").failure == "dark."


@pytest.mark.parametrize("name", ["a\x1b[31m", "", "x" * 61, "a\u202e"])
def test_a_plug_in_that_cannot_be_listed_is_left_out(
    monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    entries = [EntryPoint(each, "hostile:raises", plugins.DECODERS) for each in (name, "fine")]
    monkeypatch.setattr("importlib.metadata.entry_points", lambda group: entries)
    forget_plugins()
    assert plugins.plugin_names(plugins.DECODERS) == ("fine",)


def test_a_decoder_cannot_change_the_signal_of_others() -> None:
    signal = occ.column_profile(SCENE)
    before = signal.copy()
    read = decoders.decoder_named("overwrites").read
    assert read(signal, SCENE).failure == "Nothing was read."
    np.testing.assert_array_equal(signal, before)


def test_a_plugin_does_not_replace_a_built_in_decoder() -> None:
    assert occ.decoders().count("threshold") == 1
    assert decode("threshold").code == SCENE.transmitter.code


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("code_raises", "cannot encode: ValueError: not today."),
        ("code_short", "gives 10 chips in place of 20."),
        ("code_grey", "gives no chips, which are zeros and ones."),
        ("code_blocks", "declares block_chips = 0; allowed: 1 to 4096."),
        ("code_run", "declares longest_run = 'two'; allowed: 1 to 4096."),
        ("code_array", "declares disparity = array([[1], [2]]); allowed: 0 to 4096."),
        ("code_maybe", "declares finds_wrong_chip = None; allowed: True or False."),
        ("code_huge", "gives 1,000,000,000,000 chips; allowed: up to 65,536."),
        ("code_preamble", "declares preamble = '012'; allowed: zeros and ones."),
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
        ("frame_raises", "cannot encode: ValueError: not today."),
        ("frame_empty", "gives no chips, which are zeros and ones."),
        ("frame_checks", "declares checks = array([], dtype=float64); allowed: True or False."),
        ("frame_huge", "gives 1,000,000,000,000 chips; allowed: up to 65,536."),
        ("frame_lines", "cannot encode: ParameterError: Two\\nlines.."),
    ],
)
def test_a_framing_that_cannot_be_sent_is_named(name: str, said: str) -> None:
    with pytest.raises(occ.PluginError) as caught:
        occ.render(SCENE.replace(framing=name))
    assert str(caught.value) == f"The plug-in '{name}' of the package 'hostile' {said}"


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"line_code": "code_mute"}, "'code_mute' of the package 'hostile' gives no bits"),
        ({"framing": "frame_mute"}, "'frame_mute' of the package 'hostile' gives no bits"),
        ({"line_code": "code_flood"}, "gives 1,000,000,000,000 bits; allowed: up to"),
        ({"framing": "frame_flood"}, "gives 1,000,000,000,000 bits; allowed: up to 10."),
        ({"framing": "frame_fails"}, "'frame_fails' of the package 'hostile' cannot decode"),
        (
            {"framing": "frame_placed"},
            "'frame_placed' of the package 'hostile' gives headers that are not places among",
        ),
    ],
)
def test_what_cannot_be_read_is_named_in_the_failure(changes: dict[str, str], said: str) -> None:
    scene = SCENE.replace(**changes, enhancement="none")
    result = occ.decode(occ.column_profile(scene), scene)
    assert said in result.failure


def test_a_scene_with_an_unknown_plugin_lists_those_there_are() -> None:
    with pytest.raises(occ.ParameterError, match=r"line_code is 'mine'; allowed: .*code_grey"):
        SCENE.replace(line_code="mine")
    text = SCENE.replace(line_code="code_mute").to_toml()
    assert occ.Scene.from_toml(text).transmitter.line_code == "code_mute"
    with pytest.raises(occ.ParameterError, match="'mine'"):
        occ.Scene.from_toml(text.replace("code_mute", "mine"))
