"""Each exception of the model ends a command with one sentence, and so does each wrong value."""

import math
import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from every_error import (
    NOT_IN_THE_SHELL,
    WRONG,
    ErrorClass,
    check_sentence,
    check_that_all_have_a_case,
    wrong_texts,
)
from model.plugins.installed_package import forget_plugins, install
from PIL import Image

import occ_model as occ
from occ_model import plugins
from occ_model.cli import main
from occ_model.commands import command_line
from occ_model.commands.sweep import ClusterError
from occ_model.errors import PluginError
from occ_model.program import EXIT_MISUSE
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.square_wave import SQUARE_FREQUENCY

Words = list[str]

CASES: dict[ErrorClass, Callable[[Path, pytest.MonkeyPatch], Words]] = {}
"""For each class the words of a command that ends with it, made in an empty folder."""


def ends_with(error: ErrorClass) -> Callable[[Callable[..., Words]], Callable[..., Words]]:
    def note(words: Callable[..., Words]) -> Callable[..., Words]:
        CASES[error] = words
        return words

    return note


@ends_with(occ.ParameterError)
def _a_value_out_of_range(folder: Path, _patch: pytest.MonkeyPatch) -> Words:
    return ["render", "--set", "distance=-3m", "-o", str(folder / "out.png")]


@ends_with(occ.SceneFileError)
def _a_scene_that_is_no_toml(folder: Path, _patch: pytest.MonkeyPatch) -> Words:
    (folder / "scene.toml").write_text("format = ", encoding="utf-8")
    return ["plan", "--scene", str(folder / "scene.toml")]


@ends_with(occ.PresetError)
def _a_preset_that_nobody_has(_folder: Path, _patch: pytest.MonkeyPatch) -> Words:
    return ["plan", "--preset", "nobody's"]


@ends_with(occ.ProjectionError)
def _a_panel_behind_the_camera(folder: Path, _patch: pytest.MonkeyPatch) -> Words:
    out = str(folder / "out.png")
    return ["render", "--set", "distance=0.1m", "--set", "yaw=70deg", "-o", out]


@ends_with(occ.PhotoError)
def _a_photo_that_is_a_text(folder: Path, _patch: pytest.MonkeyPatch) -> Words:
    (folder / "photo.png").write_text("no photo", encoding="utf-8")
    return ["match", str(folder / "photo.png")]


@ends_with(occ.VideoError)
def _a_film_that_is_a_text(folder: Path, _patch: pytest.MonkeyPatch) -> Words:
    (folder / "film.mp4").write_text("no film", encoding="utf-8")
    return ["decode", "--follow", str(folder / "film.mp4")]


@ends_with(occ.MatchError)
def _a_photo_without_stripes(folder: Path, _patch: pytest.MonkeyPatch) -> Words:
    Image.fromarray(np.full((60, 90), 128, np.uint8)).save(folder / "grey.png")
    return ["match", str(folder / "grey.png")]


@ends_with(PluginError)
def _a_line_code_that_cannot_be_imported(folder: Path, patch: pytest.MonkeyPatch) -> Words:
    install(folder, "broken", {plugins.LINE_CODES: {"mine": "broken:code"}}, "1 / 0\n")
    patch.syspath_prepend(str(folder))
    forget_plugins()
    return ["render", "--set", "line_code=mine", "-o", str(folder / "out.png")]


@ends_with(occ.OutputError)
def _a_folder_to_write_to(folder: Path, _patch: pytest.MonkeyPatch) -> Words:
    (folder / "out.png").mkdir()
    return ["render", "--set", "rows=20", "-o", str(folder / "out.png")]


@ends_with(ClusterError)
def _a_cluster_without_its_package(_folder: Path, patch: pytest.MonkeyPatch) -> Words:
    patch.setitem(sys.modules, "distributed", None)
    return ["sweep", "--vary", "distance=0.5,1", "--cluster", "tcp://127.0.0.1:8786"]


@pytest.fixture
def ended_with(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[BaseException]]:
    """Give what the commands raise from now on; one parser serves them all."""
    raised: list[BaseException] = []
    run = command_line.run_command

    def note(options: object) -> int:
        try:
            return run(options)  # type: ignore[arg-type]
        except BaseException as error:
            raised.append(error)
            raise

    monkeypatch.setattr(command_line, "run_command", note)
    monkeypatch.setattr(command_line, "make_parser", cache(command_line.make_parser))
    yield raised
    forget_plugins()


def test_every_class_has_a_case() -> None:
    check_that_all_have_a_case(dict(CASES), NOT_IN_THE_SHELL)


@pytest.mark.parametrize("error", CASES, ids=lambda error: error.__name__)
def test_every_class_ends_a_command_with_one_sentence(
    error: ErrorClass,
    ended_with: list[BaseException],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = CASES[error](tmp_path, monkeypatch)
    assert main(words) == EXIT_MISUSE
    assert [type(each) for each in ended_with] == [error]
    out, err = capsys.readouterr()
    assert out == ""
    assert err == f"occ-model: {ended_with[0]}\n"
    assert err.rstrip("\n").isprintable()
    assert err.endswith(".\n")
    assert not (tmp_path / "out.png").is_file()


def test_every_wrong_value_is_named_with_its_unit_and_range(
    ended_with: list[BaseException], capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in WRONG:
        assert main(["plan", "--set", f"{name}={text}"]) == EXIT_MISUSE, (name, text)
        out, err = capsys.readouterr()
        assert out == ""
        assert type(ended_with[-1]) is occ.ParameterError
        prefix, _, sentence = err.rstrip("\n").partition(": ")
        assert prefix == "occ-model"
        check_sentence(sentence, PARAMETERS[name], text, f"{name} is ")


@pytest.mark.parametrize("text", wrong_texts(SQUARE_FREQUENCY))
def test_a_wrong_frequency_of_the_led_is_named_as_it_was_given(
    text: str, ended_with: list[BaseException]
) -> None:
    main(["match", "photo.png", "--led-frequency", text])
    check_sentence(str(ended_with[0]), SQUARE_FREQUENCY, text, "--led-frequency is ")


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_number_that_is_not_finite_is_named_with_its_unit_and_range(value: float) -> None:
    for name, declared in PARAMETERS.items():
        if isinstance(declared, Quantity) and declared.high != value:
            with pytest.raises(occ.ParameterError) as refusal:
                occ.Scene().replace(**{name: value})
            unit = declared.format(value).removeprefix(str(value))
            assert str(refusal.value) == f"{name} is {value}{unit}; allowed: {declared.allowed}."
