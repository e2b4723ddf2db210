"""The pages of the manual and the README: their links, tables, examples and commands."""

import math
import re
import shlex
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from documents import FOLDER, PAGES, README, ROOT, blocks, links, text_of, without_code
from each_case import each_case

import occ_model as occ
from occ_gui.app.command_line import read_command_line as read_gui_line
from occ_gui.help.pages import CONTENTS, heading_id, pages
from occ_model.camera.photometry import level_values, white_electrons
from occ_model.commands.command_line import read_command_line
from occ_model.commands.listing import framing_table, line_code_table, parameter_table
from occ_model.effects.registry import EFFECTS
from occ_model.scene.presets import preset_from

CONTRIBUTING = ROOT / ".github" / "CONTRIBUTING.md"

every_page = each_case(PAGES)
every_document = each_case([README, CONTRIBUTING, *PAGES])

_README = text_of(README)


def headings(page: Path) -> list[str]:
    return re.findall(r"^#+ (.+)$", without_code(text_of(page)), re.MULTILINE)


def page_named(name: str) -> str:
    return text_of(FOLDER / f"{name}.md")


@every_page
def test_every_link_leads_to_a_page_heading_or_picture_of_ours(page: Path) -> None:
    for link in links(text_of(page)):
        name, _, heading = link.partition("#")
        target = (FOLDER / name).resolve() if name else page
        assert target.is_file(), link
        assert target.parent in (FOLDER, ROOT / "resources" / "pictures"), link
        if heading:
            assert heading in map(heading_id, headings(target)), link


@every_page
def test_a_page_begins_with_its_only_title(page: Path) -> None:
    text = without_code(text_of(page))
    assert text.startswith("# ")
    assert len(re.findall(r"^# ", text, re.MULTILINE)) == 1


def test_the_contents_list_every_page() -> None:
    assert sorted(name for _, name in pages(FOLDER)) == [page.name for page in PAGES]
    assert pages(FOLDER)[0][1] == CONTENTS


def test_every_picture_is_shown_somewhere() -> None:
    shown = {Path(link).name for page in [README, *PAGES] for link in links(text_of(page))}
    pictures = {path.name for path in (ROOT / "resources" / "pictures").iterdir()}
    assert pictures <= shown


@every_document
def test_every_table_has_one_head_and_rows_as_long(page: Path) -> None:
    for table in re.findall(r"(?:^\|.*\n)+", without_code(text_of(page)), re.MULTILINE):
        head, line, *rows = table.splitlines()
        assert re.fullmatch(r"\|(---\|)+", line), table
        assert {row.count("|") for row in rows} == {head.count("|")}, table


@every_document
def test_every_path_of_the_project_is_there(page: Path) -> None:
    named = re.findall(r"\b((?:occ_model|occ_gui|tests|resources)/[\w/.-]*\w)", text_of(page))
    drawn_by_us = ("resources/pictures/",)
    missing = [name for name in named if not (ROOT / name).exists()]
    assert [name for name in missing if not name.startswith(drawn_by_us)] == []


@every_page
def test_every_name_is_in_the_file_that_it_is_said_to_be_in(page: Path) -> None:
    said = re.findall(r"`(\w+)`\s+(?:in|of)\s+`(occ_\w+/[\w/]+\.py)`", text_of(page))
    assert [name for name, file in said if name not in text_of(ROOT / file)] == []


RESULTS = {
    "frame": (occ.Frame, occ.VideoFrame), "plan": (occ.Plan,), "match": (occ.Match,),
    "result": (occ.DecodeResult,), "film": (occ.Video,),
}  # fmt: skip
"""The classes that the pages' names of results stand for."""


@every_page
def test_every_attribute_of_a_result_that_is_named_is_there(page: Path) -> None:
    named = re.findall(rf"`({'|'.join(RESULTS)})\.(\w+)", text_of(page))
    assert [
        (name, attribute)
        for name, attribute in named
        if not any(attribute in {*dir(kind), *kind.__annotations__} for kind in RESULTS[name])
    ] == []


def commands(text: str) -> list[list[str]]:
    """Return the words of every command of ours that a document names."""
    code = "\n".join(blocks(text, "")).replace("\\\n", " ")
    inline = [" ".join(c.split()) for c in re.findall(r"`([^`]+)`", without_code(text))]
    lines = [line.removeprefix("$ ") for line in [*code.splitlines(), *inline]]
    return [shlex.split(line, comments=True) for line in lines if line.startswith("occ-")]


def test_most_pages_name_a_command() -> None:
    assert sum(bool(commands(text_of(page))) for page in PAGES) > 6


@every_document
def test_every_command_is_one_that_the_program_takes(page: Path) -> None:
    read = {"occ-gui": read_gui_line, "occ-model": read_command_line}
    for program, *words in commands(text_of(page)):
        if {"...", "--help"}.isdisjoint(words):
            read[program](words)  # ends the test where it does not understand them


def test_the_table_of_parameters_is_that_of_the_declarations() -> None:
    """``occ-model parameters --markdown`` prints it anew."""
    assert parameter_table() in page_named("parameters")


def test_the_tables_of_codes_are_those_of_the_declarations() -> None:
    """``occ-model codes --markdown`` prints them anew."""
    assert line_code_table() in page_named("decoding")
    assert framing_table() in page_named("decoding")


def test_the_table_of_effects_is_that_of_the_registry() -> None:
    (table,) = re.findall(r"^\| effect \|.*?\n\n", page_named("model"), re.MULTILINE | re.DOTALL)
    named = re.findall(r"^\| ([^|]+) \|", table, re.MULTILINE)
    assert named[1:] == [effect.label for effect in EFFECTS]


def test_the_table_of_electrons_is_that_of_the_presets() -> None:
    rows = re.findall(r"^\| (\S+) ((?:\| [\d.]+ ){6})\|$", page_named("model"), re.MULTILINE)
    assert {name for name, _ in rows} == {
        n for n in occ.presets() if not n.endswith(("-real", "-colour"))
    }
    for name, cells in rows:
        scene = occ.load_preset(name)
        white = white_electrons(scene)
        levels = white * (level_values(scene) / 255.0) ** scene.camera.gamma
        sensor = scene.sensor
        expected = [*levels, white, sensor.full_well, sensor.read_noise, sensor.adc_bits]
        assert [float(cell) for cell in cells.split("|")[1:]] == pytest.approx(expected, rel=4e-3)


def test_as_many_effects_as_the_page_says_are_called_for_at_two_tolerances() -> None:
    scene = occ.load_preset("phone-136us-real")
    few, most, every = (len(occ.plan(scene, each).included) for each in (10.0, 1.0, 0.0))
    assert (few, most, every) == (4, 8, 9)
    page = " ".join(page_named("model").split())
    assert "includes four of nine effects, and `--tolerance 1` eight." in page


def test_the_draft_of_the_example_is_as_near_to_its_picture_as_the_page_says() -> None:
    scene = occ.load_preset("phone-136us-real")
    draft = occ.render(scene, rows_step=9)
    columns = occ.panel_corners(scene)[:, 0]
    on_panel = slice(math.ceil(columns.min()), math.ceil(columns.max()))
    whole = occ.render(scene)
    off = [
        getattr(draft, name)[on_panel] - getattr(whole, name)[on_panel]
        for name in ("profile", "signal")
    ]
    found = [float(np.sqrt(np.mean(difference**2))) for difference in off]
    page = " ".join(page_named("model").split())
    (numbers,) = re.findall(r"they lie ([\d.]+) and ([\d.]+) grey levels from", page)
    assert found == pytest.approx([float(number) for number in numbers], rel=0.05)


def test_detection_ceases_where_the_table_of_limits_ends() -> None:
    """README and the table of the paper name frequencies that the table of limits has."""
    page = page_named("validation")
    ends = re.findall(
        r"^\| (phone-136us|tablet-122us)(?:-real)? \| \S+ to (\S+) \|", page, re.MULTILINE
    )
    found = {f"{float(end):.1f}" for _, end in ends}
    assert len(found) == 4
    for text in (_README, page):
        said = re.findall(r"(?:ceases|with a real lens,) at (\d+\.\d) kHz", text)
        assert len(said) == 4
        assert set(said) <= found


def test_the_validation_names_every_program_that_measures() -> None:
    programs = [
        path.relative_to(ROOT).as_posix()
        for path in sorted((ROOT / "tests" / "benchmarks").glob("*.py"))
        if "__main__" in text_of(path)
    ]
    assert len(programs) > 8
    assert [name for name in programs if name not in page_named("validation")] == []


def test_the_picture_of_a_slider_s_move_names_what_is_in_the_code() -> None:
    """Names are drawn bold. Those of the page's text stand in the files that it names."""
    drawing = ElementTree.parse(ROOT / "resources" / "pictures" / "slider-move.svg")
    named = {each.text for each in drawing.iter() if each.get("font-weight") == "bold"}
    files = [*ROOT.glob("occ_gui/**/*.py"), *ROOT.glob("occ_model/**/*.py")]
    code = "\n".join(map(text_of, files))
    there = set(re.findall(r"^(?:class|def) (\w+)", code, re.MULTILINE))
    assert len(named) > 10
    assert named <= there


def test_the_preset_of_the_manual_can_be_loaded() -> None:
    text, _ = blocks(page_named("developers"), "toml")
    preset = preset_from("my-camera", text)
    assert preset.scene.camera.readout_time == 9.2e-6
    assert preset.scene.camera.exposure_time == 136e-6
    assert set(preset.assumed) >= {"f_number"}


def test_the_readme_has_at_most_150_lines() -> None:
    assert len(_README.splitlines()) <= 150


def test_every_file_that_the_readme_names_is_there() -> None:
    named = [*links(_README), *re.findall(r"python3? ([\w/.]+\.py)", _README)]
    assert len(named) > 8
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_the_readme_links_to_every_page_of_the_manual() -> None:
    assert {*PAGES} <= {(ROOT / name).resolve() for name in links(_README)}


def test_the_readme_s_python_example_runs_in_six_lines() -> None:
    (code,) = blocks(_README, "python")
    assert len([line for line in code.splitlines() if line.strip()]) <= 6
    names: dict[str, object] = {}
    exec(compile(code, "README", "exec"), names)
    assert names["result"].code == 718  # type: ignore[attr-defined]


def folders(package: str) -> list[str]:
    found = [path.parent.name for path in (ROOT / package).glob("*/__init__.py")]
    assert len(found) > 10
    return found


def test_the_readme_explains_every_folder_of_the_model_in_a_line() -> None:
    explained = re.findall(r"^    (\w+)  +\w", _README, re.MULTILINE)
    assert sorted(explained) == sorted(folders("occ_model"))


def test_every_folder_of_the_window_is_in_the_readme_s_drawing() -> None:
    (drawing,) = re.findall(r"^occ_gui/.*?\n\n", _README, re.MULTILINE | re.DOTALL)
    arrows = drawing.partition("\n")[2]
    panes = re.findall(r"\w+", arrows)
    assert sorted(panes) == sorted(folders("occ_gui"))
