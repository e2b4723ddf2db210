"""Load lessons from TOML files, of the package and of a teacher's own folder."""

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from occ_model.errors import OccError, SceneFileError, one_line, printable, shown
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
PANES = ("profile", "decode", "accuracy", "photo", "equations", "exposure", "map", "room")
"""The panes that a step can show."""

EQUATIONS = (  # the equations that a step can show
    "lit-panel", "dark-panel", "column", "one-state", "transition", "chip-columns",
    "frame-time", "null",
)  # fmt: skip

ACTIONS = (
    "transmitter",
    "photo",
    "match",
)  # of a step's button: write files, open or match a photo
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
    own: list[Lesson] = []
    problems: dict[str, str] = {}
    for path in files_in(lessons_folder(), _ENDING):
        try:
            own.append(read_lesson(path))
        except OccError as error:
            problems[one_line(path.name)] = str(error)
    return LoadedLessons((*_package_lessons(), *own), problems)


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
    """Make the folder of the user's own lessons; an empty one gets a lesson to start from."""
    folder = lessons_folder()
    make_folder(folder)
    if not files_in(folder, _ENDING):
        text = resource_text(_FOLDER, "template", _TEMPLATE)
        write_whole(folder / _TEMPLATE, text.encode("utf-8"))
    return folder


def read_lesson(path: Path) -> Lesson:
    return _parse_lesson(path.stem, read_text(path))


def _parse_lesson(name: str, text: str) -> Lesson:
    where = one_line(name)
    try:
        content = parse_toml(text)
    except SceneFileError as error:
        raise SceneFileError(f"{where} is not a lesson: {error}") from None
    place: int | None = None
    try:
        _check_keys(content, _LESSON_KEYS, "lesson")
        title = one_line(_get_paragraph(content, "title"))
        summary = _get_paragraph(content, "summary", "")
        listed = content.get("step")
        if not isinstance(listed, list) or not listed:
            raise MistakeError("it has no steps; begin each with [[step]].", "step")
        steps = []
        for place, item in enumerate(listed):  # noqa: B007 - its last value places an error
            steps.append(_parse_step(item))
        return Lesson(name, title, summary, tuple(steps), _get_switch(content, "sheet"))
    except OccError as error:
        key = error.key if isinstance(error, MistakeError) else "set"
        line = _find_line(text, place, key)
        raise SceneFileError(f"{where} is not a lesson: line {line}: {error}") from None


def _find_line(text: str, step: int | None, key: str) -> int:
    """Find the line, from 1, of a key at the head or in a step, else that of the step itself."""
    lines = text.splitlines() or [""]
    heads = [i for i, line in enumerate(lines) if re.match(r"\s*\[\[\s*step\s*\]\]", line)]
    if step is None:
        begin, end = 0, heads[0] if heads else len(lines)
    elif step < len(heads):
        begin = heads[step]
        end = heads[step + 1] if step + 1 < len(heads) else len(lines)
    else:  # steps that are not separate tables
        begin, end = 0, len(lines)
    wanted = re.compile(rf"\s*(?:\[+\s*(?:step\s*\.\s*)?)?{re.escape(key)}\s*(?:=|\.|\])")
    found = (i for i in range(begin, end) if key and wanted.match(lines[i]))
    return next(found, begin) + 1


def _parse_step(content: object) -> LessonStep:
    if not isinstance(content, Mapping):
        raise MistakeError(f"a step is {shown(content)}; begin each with [[step]].", "step")
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
    asked = content.get("check")
    if asked is None:
        return None
    try:
        if not isinstance(asked, Mapping):
            raise MistakeError(f"check is {shown(asked)}, not a table with a quantity.")
        _check_keys(asked, _CHECK_KEYS, "check")
        quantity = _get_choice(asked, "quantity", tuple(QUANTITIES))
        if not quantity:
            raise MistakeError(f"check has no quantity; known are {', '.join(QUANTITIES)}.")
        percent = asked.get("tolerance", 2)
        number = isinstance(percent, int | float) and not isinstance(percent, bool)
        if not number or not 0.0 <= percent <= _MAX_TOLERANCE:
            raise MistakeError(
                f"tolerance is {shown(percent)}; allowed: 0 to {_MAX_TOLERANCE:g}, in percent."
            )
        unit, about = QUANTITIES[quantity].asked_in, _apply_settings(scene, asked)
        return Check(quantity, unit, percent / 100.0, about, tuple(asked.get("set", ())))
    except OccError as error:
        raise MistakeError(str(error), "check") from None


def _apply_settings(scene: Scene, content: Mapping[str, Any]) -> Scene:
    values = content.get("set", {})
    if not isinstance(values, Mapping):
        raise MistakeError(f"set is {shown(values)}, not a table of parameters.", "set")
    settings = [f"{name}={_format_setting(value)}" for name, value in values.items()]
    return change_scene(scene, settings)


def _format_setting(value: object) -> str:
    """Format a value as for an option of the command line."""
    return value if isinstance(value, str) else shown(value)


def _check_keys(content: Mapping[str, Any], known: tuple[str, ...], kind: str) -> None:
    for key in content:
        if key not in known:
            raise MistakeError(
                f"a {kind} has no key {shown(key)}; known are {', '.join(known)}.", one_line(key)
            )


def _get_text(content: Mapping[str, Any], key: str, default: str | None = None) -> str:
    value = content.get(key, default)
    if value is None:
        raise MistakeError(f"{key} is missing.")
    if not isinstance(value, str):
        raise MistakeError(f"{key} is {shown(value)} in place of a text.", key)
    if default is None and not value.strip():
        raise MistakeError(f"{key} is empty; allowed: a text.", key)
    return value


def _get_paragraph(content: Mapping[str, Any], key: str, default: str | None = None) -> str:
    return printable(_get_text(content, key, default))


def _get_choice(content: Mapping[str, Any], key: str, known: tuple[str, ...]) -> str:
    value = _get_text(content, key, "")
    if value and value not in known:
        raise MistakeError(f"{key} is {shown(value)}; known are {', '.join(known)}.", key)
    return value


def _get_switch(content: Mapping[str, Any], key: str) -> bool:
    value = content.get(key, False)
    if not isinstance(value, bool):
        raise MistakeError(f"{key} is {shown(value)}; allowed: true and false.", key)
    return value
