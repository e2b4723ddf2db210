"""Plug-ins that raise or return rubbish: each is named in a sentence, and the program goes on."""

import csv
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from model.plugins.installed_package import importable

import occ_model as occ
from occ_model import plugins
from occ_model.cli import main
from occ_model.commands.limits import sentences
from occ_model.files.writing import write_image
from occ_model.receiver import decode as decoding
from occ_model.results.bit_errors import BenchRequest
from occ_model.results.sweep_request import RateSettings
from occ_model.study.bench.bench import measure_bench_point
from occ_model.study.most_bits import most_bits
from occ_model.study.sweep.sweep import measure_point

MODULE = """
from dataclasses import replace

import numpy as np

import occ_model as occ
from occ_model.transmitter.framings.preamble import FRAMING
from occ_model.transmitter.line_codes.manchester import LINE_CODE


def fail(*_):
    raise ValueError("not today")


def sometimes(signal, scene):
    if scene.transmitter.switching_frequency > 4e3:
        raise ValueError("too fast")
    return occ.DecodeResult("sometimes", failure="Nothing was read.")


def sure(signal, scene):
    read = occ.decode(signal, scene, "threshold")
    return replace(read, confidence=0.75)


def overwrite(signal, scene):
    signal[:] = 0
    return occ.DecodeResult("overwrites", failure="Nothing\\nwas read.")


def leave(signal, scene):
    raise SystemExit(3)


def decoder(name, read):
    return occ.Decoder(name, name, read)


def make_spoiled(name, **parts):
    read = occ.DecodeResult(name, code=1, bits=np.array([1]), chips=np.array([1, 0]))
    return decoder(name, lambda *_: replace(read, **parts))


raises, leaves = decoder("raises", fail), decoder("leaves", leave)
nothing = decoder("nothing", lambda *_: None)
empty = decoder("empty", lambda *_: occ.DecodeResult("empty"))
floats = make_spoiled("floats", bits=np.array([0.5]))
overwrites = decoder("overwrites", overwrite)
misnamed = decoder("another", fail)
occasional, confident = decoder("occasional", sometimes), decoder("confident", sure)
threshold = decoder("threshold", fail)

code_raises = replace(LINE_CODE, name="code_raises", encode=fail, decode=fail)
code_short = replace(LINE_CODE, name="code_short", encode=lambda bits, level: bits)
code_grey = replace(LINE_CODE, name="code_grey", encode=lambda bits, _: np.arange(2 * len(bits)))
code_partial = replace(
    LINE_CODE, name="code_partial", decode=lambda chips, level: occ.Decoded(chips[:3])
)
code_mute = replace(LINE_CODE, name="code_mute", decode=lambda chips, level: None)

code_scalar = replace(LINE_CODE, name="code_scalar", encode=lambda *_: np.array(1))
frame_empty = replace(FRAMING, name="frame_empty", encode=lambda bits, form: np.array([]))
frame_varies = replace(
    FRAMING, name="frame_varies", encode=lambda bits, _: np.resize([1, 0], 50 + int(bits.sum()))
)
frame_fails = replace(FRAMING, name="frame_fails", decode=fail)
frame_elsewhere = replace(
    FRAMING, name="frame_elsewhere", decode=lambda *_: occ.Framed((-1,), np.array([1]))
)
frame_says_nothing = replace(
    FRAMING, name="frame_says_nothing", decode=lambda *_: occ.Framed((), np.array([]))
)
"""

DECODERS = [
    "raises", "leaves", "nothing", "empty", "floats", "overwrites", "misnamed", "threshold",
    "gone", "occasional", "confident",
]  # fmt: skip
CODES = ["code_raises", "code_short", "code_grey", "code_mute", "code_scalar", "code_partial"]
FRAMINGS = [
    "frame_empty", "frame_fails", "frame_elsewhere", "frame_says_nothing", "frame_varies",
]  # fmt: skip


SCENE = occ.load_preset("phone-68us").replace(rows=100, distance=0.6, switching_frequency=4e3)


def list_entries(names: list[str], module: str = "hostile") -> dict[str, str]:
    return {name: f"{module}:{name}" for name in names}


@pytest.fixture(autouse=True)
def _hostile(tmp_path: Path) -> Iterator[None]:
    """Install hostile plug-ins, which no other test sees."""
    groups = {
        plugins.DECODERS: list_entries(DECODERS) | {"broken": "broken_import:DECODER"},
        plugins.LINE_CODES: list_entries(CODES),
        plugins.FRAMINGS: list_entries(FRAMINGS),
    }
    (tmp_path / "broken_import.py").write_text("raise SystemExit('no licence')\n")
    with importable(tmp_path, "hostile", groups, MODULE):
        yield


def decode(decoder: str) -> occ.DecodeResult:
    return occ.decode(occ.column_profile(SCENE), SCENE, decoder)


@pytest.mark.parametrize(
    ("decoder", "said"),
    [
        ("raises", "cannot read: ValueError: not today."),
        ("leaves", "cannot read: SystemExit: 3."),
        ("nothing", "gives a NoneType, not a DecodeResult."),
        ("empty", "gives 0 bits in place of 10, and no failure."),
        ("floats", "gives bits that are not an array of zeros and ones."),
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
def test_a_plugin_that_is_not_a_decoder_is_refused_by_name(decoder: str, said: str) -> None:
    with pytest.raises(occ.PluginError) as caught:
        decode(decoder)
    expected = f"The plug-in '{decoder}' of the package 'hostile' {said}"
    assert str(caught.value).startswith(expected)


def test_a_decoder_cannot_change_the_signal_of_others() -> None:
    signal = occ.column_profile(SCENE)
    before = signal.copy()
    read = decoding.decoder_named("overwrites").read
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
        ("code_scalar", "gives chips that are not an array of zeros and ones."),
        ("code_grey", "gives chips that are not an array of zeros and ones."),
    ],
)
def test_a_line_code_that_cannot_be_sent_is_named(name: str, said: str) -> None:
    scene = SCENE.replace(line_code=name)
    with pytest.raises(occ.PluginError) as caught:
        occ.packet(scene)
    assert str(caught.value) == f"The plug-in '{name}' of the package 'hostile' {said}"


def test_a_framing_that_cannot_be_sent_is_named() -> None:
    with pytest.raises(occ.PluginError) as caught:
        occ.render(SCENE.replace(framing="frame_empty"))
    said = "The plug-in 'frame_empty' of the package 'hostile' gives no chips."
    assert str(caught.value) == said


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"line_code": "code_mute"}, "gives a NoneType, not a Decoded."),
        ({"line_code": "code_partial", "framing": "preamble"}, "gives 3 bits in place of 10."),
        ({"framing": "frame_says_nothing"}, "gives 0 bits in place of 10, and no failure."),
        ({"framing": "frame_elsewhere"}, "gives 1 bits in place of 10, and no failure."),
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


def test_a_framing_whose_payloads_have_other_lengths_is_named() -> None:
    scene = SCENE.replace(framing="frame_varies")
    assert len(occ.packet(scene.replace(code=0))) == 50
    with pytest.raises(occ.PluginError, match="gives 51 chips for one payload, 50 for another"):
        occ.packet(scene.replace(code=1))


def test_the_shell_prints_what_a_decoder_says_of_itself_and_no_more(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture, scene = tmp_path / "picture.png", tmp_path / "scene.toml"
    write_image(picture, occ.render(SCENE).image)
    scene.write_text(SCENE.to_toml())
    assert main(["decode", str(picture), "--scene", str(scene), "--decoder", "confident"]) == 0
    said = capsys.readouterr().out
    assert "confidence   0.750\n" in said
    assert "correlation" not in said


FIRST = "The plug-in '{0}' of the package 'hostile' cannot read: {1}."
ALWAYS = "With the raises decoder a plug-in failed in {0} of {0} readings; first: " + FIRST.format(
    "raises", "ValueError: not today"
)


def test_a_rate_of_a_plug_in_that_fails_is_none() -> None:
    with pytest.raises(occ.PluginError) as caught:
        occ.success_rate(SCENE, 3, "raises")
    assert str(caught.value) == ALWAYS.format(3)
    assert occ.success_rate(SCENE, 3, "occasional") == 0.0


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_sweep_says_where_and_how_often_a_plug_in_has_failed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], jobs: int
) -> None:
    scene, table = tmp_path / "scene.toml", tmp_path / "table.csv"
    scene.write_text(SCENE.to_toml())
    words = ["sweep", "--scene", str(scene), "--vary", "switching_frequency=3kHz,4kHz,5kHz,6kHz"]
    words += ["--images", "2", "--decoder", "occasional", "--decoder", "threshold"]
    words += ["--jobs", str(jobs), "--out", str(table)]
    expected = (
        "With the occasional decoder a plug-in failed in 2 of 2 readings; first: "
        + FIRST.format("occasional", "ValueError: too fast")
    )
    for _ in range(2):  # also where all of it is read from the file
        assert main(words) == 0
        assert f"occ-model: At 2 points: {expected}\n" in capsys.readouterr().err
        lines = table.read_text().splitlines()
        rows = list(csv.DictReader(line for line in lines if line[0] != "#"))
        assert [row["note"] for row in rows] == [""] * 4 + [expected] * 4
    assert [float(row["success rate (%)"]) for row in rows[1::2]] == [100.0] * 4


def test_every_study_says_how_often_a_plug_in_has_failed() -> None:
    errors = occ.bit_error_rate(SCENE, "raises", bits=20)
    assert errors.faults == ALWAYS.format(2)
    assert occ.bit_error_rate(SCENE, "threshold", bits=20).faults == ""
    found = occ.limits(SCENE, "raises", images=2)
    for each in (found.frequency, found.exposure):
        assert re.sub(r"\d+", "N", each.faults) == ALWAYS.format("N")
        assert f"failed in {each.own.images} of" not in each.faults  # of all values tried
    assert any(ALWAYS[:40] in line for line in sentences([found]))
    (most,) = most_bits(SCENE, ("raises",), pictures=2)
    assert re.sub(r"\d+", "N", most.faults) == ALWAYS.format("N")
    request = BenchRequest(decoders=("raises", "threshold"), payload_bits=8, bits=16, rows=200)
    bad, good = measure_bench_point(request, request.points[0])
    assert bad.errors.faults == bad.note == ALWAYS.format(2)
    assert good.errors.faults == ""
    film = occ.render_video(SCENE.replace(enhancement="none"), 3)
    assert occ.decode_video(film, SCENE.replace(enhancement="none"), "raises").faults == (
        ALWAYS.format(3)
    )


@pytest.mark.parametrize("changes", [{"line_code": "code_mute"}, {"framing": "frame_fails"}])
def test_failures_of_a_line_code_or_a_framing_are_counted_too(changes: dict[str, str]) -> None:
    point = measure_point(
        SCENE.replace(**changes), RateSettings(2, ("threshold", "matched")), 0, {}
    )
    name = next(iter(changes.values()))
    assert f"failed in 2 of 2 readings; first: The plug-in '{name}'" in point.note
