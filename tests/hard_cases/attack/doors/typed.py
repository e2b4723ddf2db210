"""What is typed in a field or handed over by a program: quantities, settings, axes, answers."""

import math
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import occ_model as occ
from hard_cases.attack import hostile
from hard_cases.attack.promise import Door
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
_SLOW = ("threshold-limit", "photo-")  # beginnings of the quantities of lessons that take a search


def _text(chance: Random) -> str:
    return hostile.quantity(chance) if chance.random() < 0.8 else hostile.word(chance)


def _near(chance: Random, declared: Any) -> str:
    """A text for a parameter: one of its values, hardly spoiled, or anything."""
    if isinstance(declared, Quantity) and chance.random() < 0.5:
        value = declared.at(chance.random()) if chance.random() < 0.7 else declared.low
        text = declared.format(value, chance.randint(1, 17))
        return text if chance.random() < 0.6 else hostile.spoiled(chance, text)
    if isinstance(declared, Choice) and chance.random() < 0.7:
        return chance.choice(declared.choices)
    return _text(chance)


def _parameter(chance: Random, _folder: Path) -> list[str]:
    declared: Any = chance.choice((*PARAMETERS.values(), *DECLARED))
    value = declared.parse(_near(chance, declared))
    assert declared.check(value) == value
    if isinstance(declared, Quantity):
        assert declared.low <= value <= declared.high
        again = declared.unit.parse(declared.unit.format(value, digits=17))
        assert again is not None
        assert math.isclose(again, value, rel_tol=1e-14), (value, again)
    else:
        assert declared.parse(declared.format(value)) == value
    return []


def _unit(chance: Random, _folder: Path) -> list[str]:
    unit, text = chance.choice(_UNITS), _text(chance)
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


def _settings(chance: Random, _folder: Path) -> list[str]:
    texts = []
    for _ in range(chance.choice((1, 1, 2, 5))):
        name = chance.choice(_NAMES)
        text = _near(chance, PARAMETERS[name])
        equals = "=" if chance.random() < 0.95 else chance.choice((":", "", "=="))
        name = name if chance.random() < 0.95 else hostile.word(chance)
        texts.append(f"{name}{equals}{text}")
    check_scene(change_scene(Scene(), texts))
    return []


def _axes(chance: Random, _folder: Path) -> list[str]:
    texts = []
    for _ in range(chance.choice((1, 1, 2))):
        name = chance.choice(_NAMES)
        count = chance.choice((1, 2, 3, 3, 3, 4))
        parts = [_near(chance, PARAMETERS[name]) for _ in range(count)]
        if chance.random() < 0.3:
            parts[-1] = f"x{hostile.number(chance)}"
        between = chance.choice((":", ":", ","))
        texts.append(f"{name}={between.join(parts)}")
    axes = axes_of(texts)
    assert 0 < math.prod(map(len, axes.values())) <= MOST_POINTS
    for name, values in axes.items():
        assert all(PARAMETERS[name].check(value) == value for value in values)
    return []


def _values(chance: Random, _folder: Path) -> list[str]:
    names = chance.sample(_NAMES, chance.choice((1, 1, 3)))
    changes: dict[str, Any] = {name: hostile.value(chance) for name in names}
    if chance.random() < 0.05:
        changes["nothing of the kind"] = 1
    check_scene(Scene().replace(**changes))
    return []


@cache
def _steps() -> tuple[LessonStep, ...]:
    """The steps of the lessons whose answers are checked soon."""
    return tuple(
        step
        for lesson in lessons().lessons
        for step in lesson.steps
        if step.check is not None and not step.check.quantity.startswith(_SLOW)
    )


def _answer(chance: Random, _folder: Path) -> list[str]:
    answer = check_answer(chance.choice(_steps()), _text(chance))
    return [answer.sentence]


def check_scene(scene: Scene) -> None:
    """See that a scene is the same again when its file is read."""
    text = scene.to_toml()
    again = Scene.from_toml(text)
    assert again == scene
    assert hash(again) == hash(scene)
    assert again.to_toml() == text


_WAYS = (_parameter, _parameter, _unit, _settings, _axes, _values, _answer)


def _typed(chance: Random, folder: Path) -> list[str]:
    return chance.choice(_WAYS)(chance, folder)


TYPED = Door(
    "typed values", "quantities, settings, axes, answers; any value of Python", _typed,
    (occ.ParameterError, occ.BandModelUndefined), fraction=300,
)  # fmt: skip
