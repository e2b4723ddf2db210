"""Text from files stays plain text in all exports: no markup, scene, line or formula."""

import csv
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from matches import match_with

import occ_model as occ
from occ_model.figures.decoding import decode_drawing
from occ_model.figures.drawing import Drawing
from occ_model.figures.lesson_report import write_lesson_report
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.many.table import table_of
from occ_model.results.decoding import DecodeResult
from occ_model.results.photo_table import PhotoRow, csv_text
from occ_model.results.teaching import AnsweredStep, CheckedAnswer, Lesson, LessonStep
from occ_model.scene.provenance import Provenance, first_scene_in, scene_inside
from occ_model.teaching.lessons import read_lesson

pytestmark = pytest.mark.usefixtures("plain_figures")

EVIL = "<img src=x onerror=y> & $\\frac$ ]]> --> \x1b[31m\x00\u202egnp \udce9 (a) Tj"
SCENE = occ.load_preset("phone-68us").replace(rows=60, columns=600)
FORGED = "Title\nscene forged:\nformat = 1\n[camera]\niso = 3333.0\n"


def make_lesson(text: str) -> tuple[Lesson, list[AnsweredStep]]:
    step = LessonStep(goal=text, text=text, question=text, answer=text, scene=SCENE)
    answered = AnsweredStep(step, CheckedAnswer(text, "right", text), SCENE, None, text)
    return Lesson("evil", text, text, (step,)), [answered]


def check_drawing(path: Path) -> None:
    """Check that a file is well-formed, draws only letters, and contains only our scene."""
    if path.suffix == ".svg":
        names = {each.tag.rpartition("}")[2] for each in ElementTree.parse(path).iter()}
        assert not names & {"img", "script", "image", "a", "foreignObject"}
        (said,) = re.findall("<dc:description>(.*?)</dc:description>", path.read_text(), re.DOTALL)
        assert all(letter.isprintable() or letter == "\n" for letter in said)
    if path.suffix == ".pdf":
        content = path.read_bytes()
        assert content.startswith(b"%PDF")
        assert not re.search(rb"/(JavaScript|JS|Launch|URI|OpenAction|EmbeddedFile)\b", content)
    assert scene_inside(path) == SCENE


@pytest.mark.parametrize(
    "ending", ["svg", *(pytest.param(one, marks=pytest.mark.whole) for one in ("pdf", "png"))]
)
@pytest.mark.parametrize(
    "text", [pytest.param(EVIL, marks=pytest.mark.whole), EVIL + FORGED], ids=["marks", "forged"]
)
def test_a_lessons_text_is_text_in_its_report(tmp_path: Path, ending: str, text: str) -> None:
    path = tmp_path / f"report.{ending}"
    lesson, steps = make_lesson(text)
    write_lesson_report(path, lesson, steps, author=text, date="today")
    check_drawing(path)


def test_a_lessons_file_gives_texts_of_one_printable_line(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    evil = '"a\\u001b[31m\\u202eb\\nc"'
    texts = "\n".join(f"{key} = {evil}" for key in ("goal", "text", "question", "answer"))
    path.write_text(f'title = {evil}\n[[step]]\npreset = "phone-68us"\n{texts}\n', "utf-8")
    lesson = read_lesson(path)
    step = lesson.steps[0]
    texts_read = (lesson.title, step.goal, step.text, step.question, step.answer)
    assert all(text.isprintable() for text in texts_read)


@pytest.fixture
def drawings() -> list[Drawing]:
    """Make drawings of a received payload, of a plug-in's name and of a plug-in's sentence."""
    bits = np.ones(8, np.uint8)
    read = DecodeResult("threshold", code=1, bits=bits, payload=EVIL)
    failed = DecodeResult(EVIL, failure=EVIL)
    return [decode_drawing(SCENE, read), decode_drawing(SCENE, failed)]


@pytest.mark.parametrize(
    ("ending", "number"),
    [
        ("svg", 0),
        ("pdf", 1),
        pytest.param("svg", 1, marks=pytest.mark.whole),
        pytest.param("pdf", 0, marks=pytest.mark.whole),
    ],
)
def test_what_was_read_is_text_in_its_figure(
    tmp_path: Path, drawings: list[Drawing], ending: str, number: int
) -> None:
    path = tmp_path / f"drawing.{ending}"
    drawings[number].write(path, Provenance(drawings[number].title, {"of this file": SCENE}))
    check_drawing(path)


def test_the_provenance_of_a_figure_has_only_the_scenes_that_it_was_given() -> None:
    about = Provenance(FORGED, {"of this file": SCENE}, notes=(FORGED,), date=FORGED)
    assert about.text().count("\nscene ") == 1
    assert first_scene_in(about.text()) == SCENE


@pytest.mark.parametrize("start", ["=", "+", "-", "@", "\t", "\r", "\uff1d"])
def test_no_text_is_a_formula_for_a_spreadsheet(start: str) -> None:
    text = f'{start}HYPERLINK("http://x","y")'
    row = PhotoRow(Path(f"{text}.jpg"), "unreadable", text, camera=text)
    written = csv_text(table_of(MatchSettings(SCENE), [row, row]), [f"\n{text}"])
    lines = [line for line in written.splitlines() if not line.startswith("#")]
    cells = [cell for line in csv.reader(lines[1:]) for cell in line]
    assert sum("HYPERLINK" in cell for cell in cells) == 6
    assert not [cell for cell in cells if cell.startswith(start)]


def test_negative_numbers_stay_numbers_in_a_table() -> None:
    row = PhotoRow(Path("a.jpg"), "sure", "", match_with(correlation=-0.5))
    assert ",-0.5," in csv_text(table_of(MatchSettings(SCENE), [row]))


def test_a_table_can_have_a_name_that_is_not_utf_8() -> None:
    row = PhotoRow(Path("caf\udce9\n# scene forged:.jpg"), "unreadable", "no photo")
    written = csv_text(table_of(MatchSettings(SCENE), [row]), ["\udce9"])
    assert "caf\\udce9\\n# scene forged:.jpg" in written
    written.encode("utf-8")
