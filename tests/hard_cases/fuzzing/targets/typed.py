"""Values typed by a user or passed by a program: quantities, settings, axes, answers."""

import math
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import occ_model as occ
from hard_cases.fuzzing.mutations import (
    mutate_once,
    random_number,
    random_quantity,
    random_text,
    random_value,
)
from hard_cases.fuzzing.target import FuzzTarget
from occ_model.commands.vary import axes_of
from occ_model.results.sweep_request import MOST_POINTS
from occ_model.results.teaching import LessonStep
from occ_model.scene import units
from occ_model.scene.from_text import change_scene
from occ_model.scene.parameter_kinds import Choice, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.recording import DECLARED
from occ_model.scene.scene import Scene
from occ_model.teaching.answers import check_answer
from occ_model.teaching.lessons import lessons

_NAMES = tuple(PARAMETERS)
_UNITS = tuple(unit for unit in vars(units).values() if isinstance(unit, units.Unit))
_SLOW = ("threshold-limit", "photo-")  # prefixes of quantities whose computation needs a search


def _text(random: Random) -> str:
    return random_quantity(random) if random.random() < 0.8 else random_text(random)


def _text_near(random: Random, declared: Any) -> str:
    """Return a text for a parameter: one of its values, often mutated, or any text."""
    if isinstance(declared, Quantity) and random.random() < 0.5:
        value = declared.at(random.random()) if random.random() < 0.7 else declared.low
        text = declared.format(value, random.randint(1, 17))
        return text if random.random() < 0.6 else mutate_once(random, text)
    if isinstance(declared, Choice) and random.random() < 0.7:
        return random.choice(declared.choices)
    return _text(random)


def _parse_parameter(random: Random, _folder: Path) -> list[str]:
    declared: Any = random.choice((*PARAMETERS.values(), *DECLARED))
    value = declared.parse(_text_near(random, declared))
    assert declared.check(value) == value
    if isinstance(declared, Quantity):
        assert declared.low <= value <= declared.high
        again = declared.unit.parse(declared.unit.format(value, digits=17))
        assert again is not None
        assert math.isclose(again, value, rel_tol=1e-14), (value, again)
    else:
        assert declared.parse(declared.format(value)) == value
    return []


def _parse_unit(random: Random, _folder: Path) -> list[str]:
    unit, text = random.choice(_UNITS), _text(random)
    meanings = unit.meanings(text)
    assert len(meanings) <= 2
    assert unit.parse(text) == (meanings[0] if len(meanings) == 1 else None)
    for value in meanings:
        assert not math.isnan(value), text
        shown = unit.format(value)
        assert shown.isprintable()
        if math.isfinite(value):
            again = unit.parse(unit.format(value, digits=17))
            assert again is not None
            assert math.isclose(again, value, rel_tol=1e-14), (text, value, again)
    return []


def _change_scene(random: Random, _folder: Path) -> list[str]:
    texts = []
    for _ in range(random.choice((1, 1, 2, 5))):
        name = random.choice(_NAMES)
        text = _text_near(random, PARAMETERS[name])
        equals = "=" if random.random() < 0.95 else random.choice((":", "", "=="))
        name = name if random.random() < 0.95 else random_text(random)
        texts.append(f"{name}{equals}{text}")
    check_scene(change_scene(Scene(), texts))
    return []


def _parse_axes(random: Random, _folder: Path) -> list[str]:
    texts = []
    for _ in range(random.choice((1, 1, 2))):
        name = random.choice(_NAMES)
        count = random.choice((1, 2, 3, 3, 3, 4))
        parts = [_text_near(random, PARAMETERS[name]) for _ in range(count)]
        if random.random() < 0.3:
            parts[-1] = f"x{random_number(random)}"
        between = random.choice((":", ":", ","))
        texts.append(f"{name}={between.join(parts)}")
    axes = axes_of(texts)
    assert 0 < math.prod(map(len, axes.values())) <= MOST_POINTS
    for name, values in axes.items():
        assert all(PARAMETERS[name].check(value) == value for value in values)
    return []


def _replace_values(random: Random, _folder: Path) -> list[str]:
    names = random.sample(_NAMES, random.choice((1, 1, 3)))
    changes: dict[str, Any] = {name: random_value(random) for name in names}
    if random.random() < 0.05:
        changes["nothing of the kind"] = 1
    check_scene(Scene().replace(**changes))
    return []


@cache
def _steps() -> tuple[LessonStep, ...]:
    """Return the steps of lessons whose answers are checked quickly."""
    return tuple(
        step
        for lesson in lessons().lessons
        for step in lesson.steps
        if step.check is not None and not step.check.quantity.startswith(_SLOW)
    )


def _check_answer(random: Random, _folder: Path) -> list[str]:
    answer = check_answer(random.choice(_steps()), _text(random))
    return [answer.sentence]


def check_scene(scene: Scene) -> None:
    """Check that a scene is unchanged when it is written and read again."""
    text = scene.to_toml()
    again = Scene.from_toml(text)
    assert again == scene
    assert hash(again) == hash(scene)
    assert again.to_toml() == text


_CASES = (
    _parse_parameter,
    _parse_parameter,
    _parse_unit,
    _change_scene,
    _parse_axes,
    _replace_values,
    _check_answer,
)


def _try_any(random: Random, folder: Path) -> list[str]:
    return random.choice(_CASES)(random, folder)


TYPED = FuzzTarget(
    "typed values", "quantities, settings, axes, answers; any value of Python", _try_any,
    (occ.ParameterError, occ.BandModelUndefined), fraction=300,
)  # fmt: skip
