"""Lessons are read from anybody's files, and a mistake in one is named with its line."""

import re
from pathlib import Path

import pytest

import occ_model as occ
from occ_model.errors import SceneFileError
from occ_model.files.resources import resource_path
from occ_model.teaching.answers import check_answer
from occ_model.teaching.lessons import (
    EQUATIONS,
    PANES,
    USER_FOLDER,
    begin_lessons_folder,
    lessons,
    read_lesson,
)
from occ_model.teaching.quantities import QUANTITIES


def test_every_lesson_names_a_pane_and_photo_that_exist() -> None:
    found = lessons().lessons
    assert [lesson.name[0] for lesson in found if not lesson.is_sheet] == list("123456789c")
    assert sum(lesson.is_sheet for lesson in found) == 3
    for lesson in found:
        assert lesson.title
        assert lesson.summary.endswith(".")
        for step in lesson.steps:
            assert step.text.endswith((".", ")"))
            assert not re.search(r"\*\w", step.text + step.question + step.answer)  # shown as it is
            assert step.question.endswith(("?", "?)"))
            assert step.answer.endswith(".")
            assert step.goal.endswith(".")
            if step.photo:
                assert resource_path("photos", f"{step.photo}.jpg").is_file()


STEP = 'preset = "phone-68us", text = "one", question = "two?", answer = "three."'


def test_a_user_s_own_file_is_read_as_a_lesson(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(f'title = "x"\nstep = [{{{STEP}, set = {{iso = 200}}}}]', encoding="utf-8")
    lesson = read_lesson(path)
    (step,) = lesson.steps
    assert (lesson.name, lesson.title, step.text) == ("mine", "x", "one")
    assert step.scene == occ.load_preset("phone-68us").replace(iso=200)


@pytest.mark.parametrize(
    "content",
    [
        "title = 1",
        "no toml",
        'title = "x"\nstep = [{}]',
        'title = "x"\nstep = 3',
        'title = "x"\n[[step]]\npreset = "none such"\ntext = "a"\nquestion = "b"\nanswer = "c"',
        'title = "x"\n[[step]]\npreset = "phone-68us"\nset = { iso = "-1" }\n'
        'text = "a"\nquestion = "b"\nanswer = "c"',
        f'title = "x"\nstep = [{{{STEP}, set = 3}}]',
        f'title = "x"\nstep = [{{{STEP}, pane = 1}}]',
        f'title = "x"\nstep = [{{{STEP.replace("one", "1")}}}]'.replace('"1"', "1"),
        f"title = 1\nstep = [{{{STEP}}}]",
        f"title = 0x{'f' * 4000}\nstep = []",
        f"{'a.' * 1500}a = 1\nstep = 3",
        f"title = {'[' * 3000}",
        f"title = {'9' * 5000}",
        f'title = "x"\nstep = [{{preset = 0x{"f" * 4000}}}]',
        f'title = "x"\nstep = [{{{STEP}, set = {{iso = 0x{"f" * 4000}}}}}]',
        "#" * 2_000_000,
    ],
    ids=lambda content: content[:20],
)
def test_a_file_that_is_no_lesson_is_refused_in_a_sentence(
    tmp_path_factory: pytest.TempPathFactory, content: str
) -> None:
    path = tmp_path_factory.mktemp("lessons") / "mine.toml"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(SceneFileError) as refused:
        read_lesson(path)
    assert str(refused.value).endswith(".")
    assert str(refused.value).isprintable()
    assert len(str(refused.value)) < 1000
    with pytest.raises(SceneFileError, match=r"missing\.toml"):
        read_lesson(path.with_name("missing.toml"))


HEAD = 'title = "x"\n'
LINES = f"""{HEAD}
[[step]]
{STEP.replace(", ", chr(10))}
"""


@pytest.mark.parametrize(
    ("added", "line", "words"),
    [
        ('qestion = "?"', 8, "no key 'qestion'"),
        ('pane = "none"', 8, "pane is 'none'; known are profile"),
        ('control = "speed"', 8, "control is 'speed'"),
        ('decoder = "none"', 8, "decoder is 'none'; known are threshold"),
        ("set = { iso = -1 }", 8, "iso is -1"),
        ('check = { quantity = "x" }', 8, "quantity is 'x'; known are chip-columns"),
        (
            'check = { quantity = "bit-rate", tolerance = 70 }',
            8,
            "tolerance is 70; allowed: 0 to 50",
        ),
        ('[step.check]\nquantity = "bit-rate"\nfor = 3', 8, "no key 'for'"),
        ('animation = "yes"', 8, "animation is 'yes'"),
        ("= 3", 8, "line 8"),
        ('[[step]]\npreset = "none"', 9, "no preset 'none'"),
        ("[[step]]", 8, "preset is missing"),
        ('[[step]]\npreset = "phone-68us"\ntext = " "', 10, "text is empty; allowed: a text."),
    ],
)
def test_a_mistake_in_a_lesson_is_named_with_its_line(
    tmp_path: Path, added: str, line: int, words: str
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(LINES + added, encoding="utf-8")
    with pytest.raises(SceneFileError) as refused:
        read_lesson(path)
    assert f"line {line}" in str(refused.value)
    assert words in str(refused.value)


def test_the_title_of_a_lesson_is_one_line(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    title = next(line for line in LINES.splitlines() if line.startswith("title"))
    path.write_text(LINES.replace(title, r'title = "Two\n lines\u001b"'), encoding="utf-8")
    assert read_lesson(path).title == r"Two lines\x1b"
    path.write_text(LINES.replace(title, 'title = ""'), encoding="utf-8")
    with pytest.raises(SceneFileError, match="line 1: title is empty; allowed: a text"):
        read_lesson(path)


def test_a_teachers_lessons_are_listed_after_those_of_the_program_and_bad_ones_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    count = len(lessons().lessons)
    monkeypatch.setenv(USER_FOLDER, str(tmp_path / "none"))
    assert (len(lessons().lessons), dict(lessons().problems)) == (count, {})
    monkeypatch.setenv(USER_FOLDER, str(tmp_path))
    (tmp_path / "good.toml").write_text(LINES, encoding="utf-8")
    (tmp_path / "bad.toml").write_text(LINES + "pane = 1", encoding="utf-8")
    found = lessons()
    assert found.lessons[count:] == (read_lesson(tmp_path / "good.toml"),)
    assert list(found.problems) == ["bad.toml"]
    assert "line 8: pane is 1; allowed: a text." in found.problems["bad.toml"]


def test_the_lesson_in_the_manual_is_valid_and_its_tables_are_complete(tmp_path: Path) -> None:
    page = resource_path("docs", "guide.md").read_text(encoding="utf-8")
    path = tmp_path / "mine.toml"
    path.write_text(page.split("```toml\n")[1].split("```")[0], encoding="utf-8")
    (step,) = read_lesson(path).steps
    assert check_answer(step, "5").outcome == "right"
    for name, quantity in QUANTITIES.items():
        row = f"| `{name}` | {quantity.meaning} | {quantity.asked_in or 'a number'} |"
        assert row in page
    for word in (*PANES, *EQUATIONS, USER_FOLDER):
        assert f"`{word}`" in page


def test_an_empty_folder_gets_a_valid_lesson_to_start_from(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(USER_FOLDER, str(tmp_path / "own"))
    folder = begin_lessons_folder()
    (written,) = folder.iterdir()
    found = lessons()
    assert not found.problems
    own = found.lessons[-1]
    assert (own.name, written.suffix) == (written.stem, ".toml")
    (checked_step,) = [step for step in own.steps if step.check is not None]
    stated_value = checked_step.answer.rpartition("=")[2].strip(" .")
    assert check_answer(checked_step, stated_value).outcome == "right"


def test_a_folder_with_a_lesson_is_left_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(USER_FOLDER, str(tmp_path))
    own = tmp_path / "mine.toml"
    own.write_text("title = 'a lesson under way'", encoding="utf-8")
    assert list(begin_lessons_folder().iterdir()) == [own]
