"""An argument of a wrong kind ends in a sentence that names it, in every public function."""

import inspect
import pickle
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from types import GenericAlias
from typing import Any, cast

import numpy as np
import pytest
from each_case import each_case
from simulated_photos import photo_of

import occ_model as occ
from occ_model import argument_kinds
from occ_model.argument_kinds import check_arguments

SCENE = occ.load_preset("phone-68us").replace(
    rows=20, columns=300, panel_width=3.0, panel_height=0.5
)
FRAME = occ.render(SCENE, tolerance=np.inf)
VIDEO = occ.render_video(SCENE, 2)
PHOTO = photo_of(FRAME.image)

RIGHT = {"scene": SCENE, "photo": PHOTO, "result": occ.DecodeResult("threshold")}

NAMES = [name for name in vars(occ)["__all__"] if inspect.isfunction(getattr(occ, name))]

WRONG: tuple[object, ...] = (
    None, 5, -1.5, float("nan"), True, "x", b"y", [None], {"a": 1}, object(), np.array("t"),
    np.zeros((2, 2, 2)), int,
)  # fmt: skip

OURS = (
    "Scene",
    "Executor",
    "Transmitter",
    "Photo",
    "Video",
    "DecodeResult",
    "Settings",
    "Recording",
    "Lamp",
    "Room",
)
"""Parts of annotations of arguments that are refused before any work."""


def of_objects() -> Iterator[tuple[str, str]]:
    for name in NAMES:
        for argument, declared in inspect.signature(getattr(occ, name)).parameters.items():
            said = str(declared.annotation)
            is_ours = any(one in said for one in OURS) and "Sequence" not in said
            is_ours = is_ours and "Path" not in said  # else the file's reader refuses it
            if (is_ours and "Iterable" not in said) or "Callable" in said:
                yield name, argument


def is_right(value: object, said: str) -> bool:
    """Whether a value is of the kind that an annotation names, told by its text alone."""
    return ("None" in said and value is None) or ("Callable" in said and callable(value))


@each_case(list(of_objects()))
def test_an_object_of_a_wrong_kind_is_refused_before_any_work(name: str, argument: str) -> None:
    function = getattr(occ, name)
    parameters = inspect.signature(function).parameters
    for wrong in WRONG:
        if is_right(wrong, str(parameters[argument].annotation)):
            continue
        given: dict[str, object] = {
            each: RIGHT.get(each, VIDEO)
            for each, declared in parameters.items()
            if declared.default is declared.empty
        }
        with pytest.raises(occ.ParameterError, match=f"^{argument} is .*; allowed: ") as refused:
            function(**given | {argument: wrong})
        allowed = str(refused.value).rpartition("; allowed: ")[2]
        assert not re.search(r"\ba [AEIOU]|\ban [^AEIOUa]", allowed)


CALLS: dict[str, tuple[Callable[..., Any], dict[str, object]]] = {
    "compare": (occ.compare, {"flattened": FRAME.profile, "simulated": FRAME.profile}),
    "decode": (occ.decode, {"image": FRAME.image, "scene": SCENE, "decoder": "threshold"}),
    "decode_video": (occ.decode_video, {"video": VIDEO, "scene": SCENE, "decoder": "threshold"}),
    "load_photo": (occ.load_photo, {"path": "nowhere.png"}),
    "load_preset": (occ.load_preset, {"name": "phone-68us"}),
    "match_photos": (occ.match_photos, {"photos": [], "scene": SCENE, "known": {}}),
    "plan": (occ.plan, {"scene": SCENE, "tolerance": 0.5, "observable": "image", "force": {}}),
    "render": (occ.render, {"scene": SCENE, "seed": 1, "rows_step": 1}),
    "render_video": (occ.render_video, {"scene": SCENE, "frames": 2, "rows_step": 1}),
    "sweep": (
        occ.sweep,
        {"scene": SCENE, "axes": {"distance": [1.0]}, "images": 1, "decoder": "threshold",
         "executor": None, "jobs": 1, "results": None, "path": "auto", "tolerance": np.inf},
    ),
    "transmitter_sketch": (occ.transmitter_sketch, {"scene": SCENE, "board": "arduino-uno"}),
    "wilson_interval": (occ.wilson_interval, {"successes": 1, "trials": 2, "level": 0.9}),
    "write_video": (occ.write_video, {"video": VIDEO, "path": "nowhere/film.mkv"}),
}  # fmt: skip


@pytest.mark.parametrize("name", CALLS)
def test_no_argument_ends_in_an_error_that_says_nothing(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    function, given = CALLS[name]
    for argument in given:
        for wrong in WRONG:
            if name == "sweep" and argument == "jobs" and wrong is WRONG[1]:
                continue  # five processes are right
            try:
                function(**given | {argument: wrong})
            except occ.OccError as error:
                assert str(error)[-1] in ".)", (argument, wrong)  # noqa: PT017 - any of ours


def test_an_argument_that_there_is_not_is_named_with_its_function() -> None:
    accuracy: Callable[..., Any] = occ.accuracy
    with pytest.raises(TypeError, match=r"^accuracy\(\) got an unexpected .* 'seeds'"):
        accuracy(SCENE, seeds=1)


class Alias:
    """An alias of arrays, as numpy has one from its version 2.5 on."""

    __value__ = np.ndarray[Any, Any]

    def __getitem__(self, item: object) -> GenericAlias:
        return GenericAlias(cast("type", self), item)


def test_an_alias_of_arrays_is_known_as_one() -> None:
    hint = Alias()[np.float64]

    def columns(profile: Any) -> int:
        return len(profile)

    columns.__annotations__["profile"] = hint
    with pytest.raises(occ.ParameterError, match="profile is None; allowed: an array of numbers"):
        check_arguments(columns)(None)
    assert check_arguments(columns)(np.arange(3.0)) == 3


def test_a_right_argument_keeps_the_error_of_a_fault_of_ours() -> None:
    def faulty(count: int) -> int:
        return [7][count]

    with pytest.raises(IndexError):
        check_arguments(faulty)(3)
    with pytest.raises(occ.ParameterError, match=r"^count is 'three'; allowed: a whole number.$"):
        check_arguments(faulty)("three")  # type: ignore[arg-type]


def test_a_checked_function_is_found_again_in_another_process() -> None:
    for name in NAMES:
        assert pickle.loads(pickle.dumps(getattr(occ, name))) is getattr(occ, name)
        assert inspect.getdoc(getattr(occ, name))
    assert argument_kinds.__doc__
