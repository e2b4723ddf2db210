"""Load lessons from TOML files, of the package and of a teacher's own folder."""

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from occ_model.errors import OccError, SceneFileError, make_printable, one_line, quote
from occ_model.files.reading import read_text
from occ_model.files.resources import files_in, resource_names, resource_text, user_folder
from occ_model.files.writing import make_folder, write_whole
from occ_model.receiver.decode import DECODERS
from occ_model.results.teaching import Check, Lesson, LessonStep, LoadedLessons
from occ_model.scene.from_text import change_scene
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.presets import load_preset
from occ_model.scene.scene import Scene
from occ_model.scene.toml_format import parse_toml
from occ_model.teaching.quantities import QUANTITIES

USER_FOLDER = "OCC_LESSONS"  # environment variable: another folder for a teacher's lessons
PANES = (
    "profile", "decode", "accuracy", "photo", "equations", "exposure", "map", "room", "colour",
)  # fmt: skip
"""The panes that a step can show."""

EQUATIONS = (  # the equations that a step can show
    "lit-panel", "dark-panel", "column", "one-state", "transition", "chip-columns",
    "frame-time", "null",
)  # fmt: skip

# Actions of a step's button: write files, open or match a photo
ACTIONS = ("transmitter", "photo", "match")
_FOLDER, _ENDING = "lessons", ".toml"
_TEMPLATE = f"my-first-lesson{_ENDING}"  # the lesson from which a teacher starts

_LESSON_KEYS = ("title", "summary", "sheet", "step")
_STEP_KEYS = (
    "goal", "text", "question", "answer", "preset", "set", "pane", "photo", "control", "check",
    "equation", "animation", "action", "own_photo", "decoder",
)  # fmt: skip
_CHECK_KEYS = ("quantity", "tolerance", "set")
_MAX_TOLERANCE = 50.0  # percent


class MistakeError(SceneFileError):
    """A mistake in a lesson: a sentence, and the key at which it is."""

    def __init__(self, sentence: str, key: str = "") -> None:
        super().__init__(sentence)
        self.key = key


def lessons() -> LoadedLessons:
    """Load the lessons of the package in order, then those of the user's own folder."""
    user_lessons: list[Lesson] = []
    problems: dict[str, str] = {}
    for path in files_in(lessons_folder(), _ENDING):
        try:
            user_lessons.append(read_lesson(path))
        except OccError as error:
            problems[one_line(path.name)] = str(error)
    return LoadedLessons((*_package_lessons(), *user_lessons), problems)


@lru_cache(maxsize=1)
def _package_lessons() -> tuple[Lesson, ...]:
    return tuple(
        _parse_lesson(name, resource_text(_FOLDER, f"{name}{_ENDING}"))
        for name in resource_names(_FOLDER, _ENDING)
    )


def lessons_folder() -> Path:
    """Return the folder of the user's own lessons, which need not exist yet."""
    return user_folder(USER_FOLDER, _FOLDER)


def begin_lessons_folder() -> Path:
    """Make the folder of the user's own lessons, with a template if it is empty."""
    folder = lessons_folder()
    make_folder(folder)
    if not files_in(folder, _ENDING):
        text = resource_text(_FOLDER, "template", _TEMPLATE)
        write_whole(folder / _TEMPLATE, text.encode("utf-8"))
    return folder


def read_lesson(path: Path) -> Lesson:
    return _parse_lesson(path.stem, read_text(path))


def _parse_lesson(name: str, text: str) -> Lesson:
    lesson_name = one_line(name)
    try:
        content = parse_toml(text)
    except SceneFileError as error:
        raise SceneFileError(f"{lesson_name} is not a lesson: {error}") from None
    step_index: int | None = None
    try:
        _check_keys(content, _LESSON_KEYS, "lesson")
        title = one_line(_get_paragraph(content, "title"))
        summary = _get_paragraph(content, "summary", "")
        step_tables = content.get("step")
        if not isinstance(step_tables, list) or not step_tables:
            raise MistakeError("it has no steps; begin each with [[step]].", "step")
        steps = []
        for step_index, item in enumerate(step_tables):  # noqa: B007 - its last value locates an error
            steps.append(_parse_step(item))
        return Lesson(name, title, summary, tuple(steps), _get_switch(content, "sheet"))
    except OccError as error:
        key = error.key if isinstance(error, MistakeError) else "set"
        line = _find_line(text, step_index, key)
        raise SceneFileError(f"{lesson_name} is not a lesson: line {line}: {error}") from None


def _find_line(text: str, step: int | None, key: str) -> int:
    """Find the line, from 1, of a key of the lesson or of a step, else that of the step itself."""
    lines = text.splitlines() or [""]
    step_lines = [i for i, line in enumerate(lines) if re.match(r"\s*\[\[\s*step\s*\]\]", line)]
    if step is None:
        begin, end = 0, step_lines[0] if step_lines else len(lines)
    elif step < len(step_lines):
        begin = step_lines[step]
        end = step_lines[step + 1] if step + 1 < len(step_lines) else len(lines)
    else:  # steps that are not separate tables
        begin, end = 0, len(lines)
    pattern = re.compile(rf"\s*(?:\[+\s*(?:step\s*\.\s*)?)?{re.escape(key)}\s*(?:=|\.|\])")
    matches = (i for i in range(begin, end) if key and pattern.match(lines[i]))
    return next(matches, begin) + 1


def _parse_step(content: object) -> LessonStep:
    if not isinstance(content, Mapping):
        raise MistakeError(f"a step is {quote(content)}; begin each with [[step]].", "step")
    _check_keys(content, _STEP_KEYS, "step")
    preset = _get_text(content, "preset")
    try:
        scene = load_preset(preset)
    except OccError as error:
        raise MistakeError(str(error), "preset") from None
    scene = _apply_settings(scene, content)
    return LessonStep(
        goal=_get_paragraph(content, "goal", ""),
        text=_get_paragraph(content, "text"),
        question=_get_paragraph(content, "question"),
        answer=_get_paragraph(content, "answer"),
        scene=scene,
        pane=_get_choice(content, "pane", PANES),
        photo=_get_text(content, "photo", ""),
        control=_get_choice(content, "control", tuple(PARAMETERS)),
        check=_parse_check(content, scene),
        equation=_get_choice(content, "equation", EQUATIONS),
        animation=_get_switch(content, "animation"),
        action=_get_choice(content, "action", ACTIONS),
        own_photo=_get_switch(content, "own_photo"),
        decoder=_get_choice(content, "decoder", tuple(DECODERS)),
    )


def _parse_check(content: Mapping[str, Any], scene: Scene) -> Check | None:
    check = content.get("check")
    if check is None:
        return None
    try:
        if not isinstance(check, Mapping):
            raise MistakeError(f"check is {quote(check)}, not a table with a quantity.")
        _check_keys(check, _CHECK_KEYS, "check")
        quantity = _get_choice(check, "quantity", tuple(QUANTITIES))
        if not quantity:
            raise MistakeError(f"check has no quantity; known are {', '.join(QUANTITIES)}.")
        percent = check.get("tolerance", 2)
        is_a_number = isinstance(percent, int | float) and not isinstance(percent, bool)
        if not is_a_number or not 0.0 <= percent <= _MAX_TOLERANCE:
            raise MistakeError(
                f"tolerance is {quote(percent)}; allowed: 0 to {_MAX_TOLERANCE:g}, in percent."
            )
        unit, scene_asked = QUANTITIES[quantity].asked_in, _apply_settings(scene, check)
        return Check(quantity, unit, percent / 100.0, scene_asked, tuple(check.get("set", ())))
    except OccError as error:
        raise MistakeError(str(error), "check") from None


def _apply_settings(scene: Scene, content: Mapping[str, Any]) -> Scene:
    values = content.get("set", {})
    if not isinstance(values, Mapping):
        raise MistakeError(f"set is {quote(values)}, not a table of parameters.", "set")
    settings = [f"{name}={_format_setting(value)}" for name, value in values.items()]
    return change_scene(scene, settings)


def _format_setting(value: object) -> str:
    """Format a value as for an option of the command line."""
    return value if isinstance(value, str) else quote(value)


def _check_keys(content: Mapping[str, Any], known: tuple[str, ...], kind: str) -> None:
    for key in content:
        if key not in known:
            raise MistakeError(
                f"a {kind} has no key {quote(key)}; known are {', '.join(known)}.", one_line(key)
            )


def _get_text(content: Mapping[str, Any], key: str, default: str | None = None) -> str:
    value = content.get(key, default)
    if value is None:
        raise MistakeError(f"{key} is missing.")
    if not isinstance(value, str):
        raise MistakeError(f"{key} is {quote(value)}; allowed: a text.", key)
    if default is None and not value.strip():
        raise MistakeError(f"{key} is empty; allowed: a text.", key)
    return value


def _get_paragraph(content: Mapping[str, Any], key: str, default: str | None = None) -> str:
    return make_printable(_get_text(content, key, default))


def _get_choice(content: Mapping[str, Any], key: str, known: tuple[str, ...]) -> str:
    value = _get_text(content, key, "")
    if value and value not in known:
        raise MistakeError(f"{key} is {quote(value)}; known are {', '.join(known)}.", key)
    return value


def _get_switch(content: Mapping[str, Any], key: str) -> bool:
    value = content.get(key, False)
    if not isinstance(value, bool):
        raise MistakeError(f"{key} is {quote(value)}; allowed: true and false.", key)
    return value
