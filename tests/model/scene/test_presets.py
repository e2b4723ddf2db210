"""The presets of the package."""

from collections.abc import Callable
from pathlib import Path

import pytest
from each_case import each_case

from occ_model.cli import main
from occ_model.errors import ParameterError, PresetError, SceneFileError
from occ_model.files import resources
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.presets import load_preset, preset_named, presets
from occ_model.scene.scene import GROUPS, Scene

PAPER = ("phone-136us", "phone-68us", "tablet-122us", "tablet-61us")

every_preset = each_case(presets())
papers_presets = pytest.mark.parametrize("name", PAPER)


def test_the_papers_four_experiments_are_listed_by_name() -> None:
    assert set(PAPER) <= set(presets())
    assert list(presets()) == sorted(presets())


@every_preset
def test_a_preset_loads_under_its_name_with_a_title_of_its_own(name: str) -> None:
    preset = preset_named(name)
    assert preset.name == name
    assert load_preset(name) == preset.scene
    assert preset.title
    assert [n for n in presets() if preset_named(n).title == preset.title] == [name]


def test_no_two_presets_are_the_same_scene() -> None:
    assert len({load_preset(name) for name in presets()}) == len(presets())


@every_preset
def test_no_value_has_both_a_source_and_an_assumption(name: str) -> None:
    preset = preset_named(name)
    assert not set(preset.sources) & set(preset.assumed)
    assert set(preset.sources) | set(preset.assumed) <= set(PARAMETERS)


@every_preset
def test_a_value_other_than_nothing_has_a_source_or_a_reason(name: str) -> None:
    preset = preset_named(name)
    notes = {**preset.sources, **preset.assumed}
    values = {
        parameter
        for parameter, declared in PARAMETERS.items()
        if declared.is_of(preset.scene.transmitter.light)
        and parameter != "light"
        and (preset.scene.colours.bayer != "none" or parameter not in GROUPS["colours"])
        and preset.scene.value(parameter) not in (0, "")
    }
    assert values <= {parameter for parameter, note in notes.items() if len(note.split()) > 1}


@papers_presets
def test_values_name_the_paper_or_are_marked_as_assumed(name: str) -> None:
    preset = preset_named(name)
    stated = {"bits", "luminance", "iso", "gamma", "meter_constant", "illuminance", "reflectance"}
    stated |= {"readout_time", "bright_fraction", "averaging", "enhancement"}
    unstated = {"code", "panel_width", "panel_height", "rows", "columns", "f_number"}
    unstated |= {"equivalent_focal_length"}
    # The paper gives the phone's exposures, and only hints at the tablet's.
    (stated if name.startswith("phone") else unstated).add("exposure_time")
    assert stated <= set(preset.sources)
    assert unstated <= set(preset.assumed)
    for parameter in stated:
        assert preset.sources[parameter].startswith("paper, ")


@papers_presets
def test_the_experiment_has_the_papers_numbers(name: str) -> None:
    scene = load_preset(name)
    expected = {
        "bits": 10,
        "pattern": "",
        "luminance": 3600.0,
        "panel_width": 0.6,
        "panel_height": 0.6,
        "iso": 100.0,
        "gamma": 2.22,
        "meter_constant": 12.5,
        "illuminance": 290.0,
        "reflectance": 0.4,
        "bright_fraction": 0.05,
        "averaging": "pixel-value",
        "enhancement": "equalization",
        "distance": 1.2,
        "switching_frequency": 10e3,
    }
    assert {parameter: scene.value(parameter) for parameter in expected} == expected


def test_a_value_and_its_source_are_apart(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["presets", "phone-136us-real"]) == 0
    lines = capsys.readouterr().out.splitlines()
    (line,) = [line for line in lines if line.startswith("line_code ")]
    assert line.split()[1:4] == ["differential-manchester", "paper,", "II:"]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder in place of the package's; use names found nowhere else, since presets are
    cached."""
    monkeypatch.setattr(resources, "resource_path", tmp_path.joinpath)
    (tmp_path / "presets").mkdir()
    return tmp_path / "presets"


def test_a_changed_values_note_replaces_the_one_before(folder: Path) -> None:
    (folder / "own-base.toml").write_text(
        'format = 1\ntitle = "Base"\n[camera]\niso = 200\ngamma = 2.0\n'
        '[sources]\niso = "a book"\n[assumed]\ngamma = "a guess"\n'
    )
    (folder / "own-child.toml").write_text(
        'format = 1\nbased_on = "own-base"\n[camera]\niso = 400\ngamma = 1.0\n'
        '[sources]\ngamma = "a measurement"\n[assumed]\niso = "a hunch"\n'
    )
    assert presets() == ("own-base", "own-child")
    child = preset_named("own-child")
    assert (child.title, child.sources, child.assumed) == (
        "Base",
        {"gamma": "a measurement"},
        {"iso": "a hunch"},
    )
    assert child.scene == Scene().replace(iso=400, gamma=1.0)
    assert preset_named("own-base").sources == {"iso": "a book"}


def test_a_note_on_an_unknown_parameter_is_refused(folder: Path) -> None:
    (folder / "own-note.toml").write_text('format = 1\n[sources]\nisoo = "a book"\n')
    with pytest.raises(ParameterError, match=r"^There is no parameter 'isoo'; did you mean iso\?$"):
        preset_named("own-note")


def test_a_preset_file_that_is_not_text_is_refused_by_its_name(folder: Path) -> None:
    (folder / "own-bytes.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(SceneFileError, match=r"^The preset file own-bytes\.toml cannot be read: "):
        preset_named("own-bytes")


@pytest.mark.parametrize("load", [load_preset, preset_named])
@pytest.mark.parametrize(
    "name",
    ["", "phone", "devices/phone", "../x", None, ["phone-136us"]],
)
def test_an_unknown_preset_is_refused_with_the_names_of_all(
    load: Callable[[object], object], name: object
) -> None:
    with pytest.raises(PresetError) as refused:
        load(name)
    sentence = str(refused.value)
    assert sentence.startswith(f"There is no preset {name!r}.")
    assert sentence.endswith(f"Known are {', '.join(presets())}.")
