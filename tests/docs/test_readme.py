"""The README: one page, whose commands and examples work."""

import re

from documents import FOLDER, PAGES, README, ROOT, blocks, links, text_of

TEXT = text_of(README)


def test_it_has_at_most_150_lines() -> None:
    assert len(TEXT.splitlines()) <= 150


def test_every_file_that_it_names_is_there() -> None:
    named = [*links(TEXT), *re.findall(r"python3? ([\w/.]+\.py)", TEXT)]
    assert len(named) > 8
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_it_links_to_every_page_of_the_manual_but_the_contents() -> None:
    linked = {(ROOT / name).resolve() for name in links(TEXT)}
    assert {*PAGES} - linked == {FOLDER / "index.md"}


def test_the_python_example_runs_in_six_lines() -> None:
    (code,) = blocks(TEXT, "python")
    assert len([line for line in code.splitlines() if line.strip()]) <= 6
    names: dict[str, object] = {}
    exec(compile(code, "README", "exec"), names)
    assert names["result"].code == 718  # type: ignore[attr-defined]


def folders(package: str) -> list[str]:
    found = [path.parent.name for path in (ROOT / package).glob("*/__init__.py")]
    assert len(found) > 10
    return found


def test_every_folder_of_the_model_is_explained_in_a_line() -> None:
    explained = re.findall(r"^    (\w+)  +\w", TEXT, re.MULTILINE)
    assert sorted(explained) == sorted(folders("occ_model"))


def test_every_folder_of_the_window_is_in_its_drawing() -> None:
    (drawing,) = re.findall(r"^occ_gui/.*?\n\n", TEXT, re.MULTILINE | re.DOTALL)
    arrows = drawing.partition("\n")[2]
    panes = re.findall(r"\w+", arrows)
    assert sorted(panes) == sorted(folders("occ_gui"))
