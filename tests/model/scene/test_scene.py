"""A scene as a value."""

import copy
import dataclasses
import pickle

import pytest
from hypothesis import given, strategies as st
from scene_values import values_of

import occ_model.scene.scene
from occ_model.errors import ParameterError
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, Scene

# A code must fit its bits, which has tests of its own.
FREE = {name: values_of(p) for name, p in PARAMETERS.items() if name not in ("code", "bits")}
changes = st.fixed_dictionaries({}, optional=FREE)


def test_the_groups_hold_every_parameter_exactly_once() -> None:
    names = [name for group in GROUPS.values() for name in group]
    assert sorted(names) == sorted(PARAMETERS)
    assert set(GROUPS) == {field.name for field in dataclasses.fields(Scene)}


@given(changes=changes)
def test_replace_changes_what_it_names_and_nothing_else(changes: dict[str, float]) -> None:
    before = Scene()
    after = before.replace(**changes)
    for name in PARAMETERS:
        assert after.value(name) == changes.get(name, PARAMETERS[name].default)
    assert before == Scene()


def test_no_field_of_a_scene_can_be_assigned() -> None:
    for name, group in (("transmitter", Scene()), ("code", Scene()), ("isoo", Scene().camera)):
        said = f"cannot assign to field '{name}'"
        with pytest.raises(dataclasses.FrozenInstanceError, match=said):
            setattr(group, name, 5)


@given(first=changes, second=changes)
def test_scenes_are_equal_when_all_their_values_are(
    first: dict[str, float], second: dict[str, float]
) -> None:
    one, other = Scene().replace(**first), Scene().replace(**second)
    same = all(one.value(name) == other.value(name) for name in PARAMETERS)
    assert (one == other) is same
    assert one == Scene().replace(**dict(reversed(first.items())))
    assert hash(one) == hash(Scene().replace(**first))
    assert {one: "found"}[Scene().replace(**first)] == "found"


@given(changes=changes)
def test_a_scene_survives_copy_pickle_and_repr(changes: dict[str, float]) -> None:
    scene = Scene().replace(**changes)
    copies = [copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))]
    copies.append(eval(repr(scene), vars(occ_model.scene.scene)))
    for same in copies:
        assert same == scene
        assert hash(same) == hash(scene)
        assert type(same) is Scene


@given(bits=values_of(PARAMETERS["bits"]), code=values_of(PARAMETERS["code"]))
def test_a_code_that_fits_its_bits_is_accepted_in_any_order(bits: int, code: int) -> None:
    for changes in ({"bits": bits, "code": code}, {"code": code, "bits": bits}):
        if code < 2**bits:
            scene = Scene().replace(**changes)
            assert (scene.value("bits"), scene.value("code")) == (bits, code)
        else:
            with pytest.raises(ParameterError) as refused:
                Scene().replace(**changes)
            assert str(refused.value) == (
                f"code is {code}; allowed with {bits} bits: 0 to {2**bits - 1}."
            )


def test_a_group_s_name_is_not_a_parameter_s() -> None:
    for group in GROUPS:
        with pytest.raises(ParameterError, match=f"^There is no parameter '{group}'; "):
            Scene().replace(**{group: getattr(Scene(), group)})


@given(frequency=st.floats(1.0, 1e9))
def test_a_chip_lasts_one_over_the_switching_frequency(frequency: float) -> None:
    transmitter = Scene().replace(switching_frequency=frequency).transmitter
    assert transmitter.switching_period * frequency == pytest.approx(1.0, rel=1e-15)


def test_a_26_mm_lens_sees_the_angle_of_its_35_mm_equivalent() -> None:
    camera = Scene().replace(rows=2400, columns=3600, equivalent_focal_length=0.026).camera
    # On a frame of 24 mm x 36 mm, with its diagonal of 43.27 mm, 3600 columns are 100 a millimetre.
    assert camera.focal_length_pixels == pytest.approx(26 * 3600 / 36, rel=1e-4)


def test_an_earlier_name_of_a_choice_opens_as_its_present_name() -> None:
    text = 'format = 1\n[model]\nband_reading = "{}"\n'
    assert Scene.from_toml(text.format("charitable")) == Scene.from_toml(text.format("aligned"))
    with pytest.raises(ParameterError, match="allowed: aligned, literal"):
        Scene.from_toml(text.format("generous"))
