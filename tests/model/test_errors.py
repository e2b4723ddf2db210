"""Any value can be quoted in a sentence; an error keeps the value it refuses and names it."""

import pickle

import pytest
from each_case import each_case

from occ_model.errors import OccError, ParameterError, inflect, one_line, quote
from occ_model.scene.parameter_kinds import Parameter
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.refusal import refusal_of, sentence_with_label


def nested(levels: int) -> object:
    value: object = []
    for _ in range(levels):
        value = [value]
    return value


@pytest.mark.parametrize(
    "value",
    [
        10**5000,
        -(10**5000),
        "x" * 10**6,
        nested(5000),
        {"a": nested(5000)},
        {"a": [["x" * 60] * 5] * 5},
        b"\0" * 10**5,
    ],
    ids=["large", "small", "text", "nested", "table", "wide table", "bytes"],
)
def test_a_value_is_quoted_in_few_characters(value: object) -> None:
    assert 0 < len(quote(value)) <= 100


@pytest.mark.parametrize("value", [718, 1.5, "10 kHz", None, True, [1, 2], {"a": 1}])
def test_a_short_value_is_quoted_as_repr_does(value: object) -> None:
    assert quote(value) == repr(value)


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (0, "0 frames"),
        (1, "1 frame"),
        (1.0, "1 frame"),
        (0.5, "0.5 frames"),
        (12345678, "12345678 frames"),
    ],
)
def test_a_number_agrees_with_its_noun(number: float, text: str) -> None:
    assert inflect(number, "frame") == text


def test_an_object_that_cannot_be_written_is_quoted_all_the_same() -> None:
    class Broken:
        def __repr__(self) -> str:
            raise RuntimeError

    assert "Broken" in quote(Broken())


def test_control_characters_are_shown_escaped() -> None:
    assert one_line("a\nb\x1b[31mc\u202ed\udc80") == "a\\nb\\x1b[31mc\\u202ed\\udc80"
    assert one_line("Stra\xdfe 5 \u03bcs") == "Stra\xdfe 5 \u03bcs"


def test_a_long_name_is_cut() -> None:
    assert len(one_line("n" * 10**7)) == 200


WRONG = ("hex:#", None, -1e99, "2" * 10_000)


def refused(declared: Parameter, value: object) -> ParameterError:
    with pytest.raises(ParameterError) as caught:
        declared.check(value)
    return caught.value


@each_case(PARAMETERS.values())
def test_the_sentence_of_every_parameters_refusal_states_its_fields(declared: Parameter) -> None:
    for wrong in WRONG:
        error = refused(declared, wrong)
        assert error.refused.parameter == declared.name
        assert str(error).startswith(f"{declared.name} {error.refused.verb} {error.refused.value}")
        assert str(error).endswith(f"; allowed: {error.refused.allowed}.")
        assert sentence_with_label(error) == str(error).replace(declared.name, declared.label, 1)
        assert refusal_of(error).startswith(f"{declared.label} cannot ")
        again = pickle.loads(pickle.dumps(error))  # as it comes from another process
        assert (str(again), again.refused) == (str(error), error.refused)
        assert again.parameters == (declared.name,)


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (
            ParameterError.of("distance", "0 m", "1 mm to 1 km"),
            "Distance cannot be 0 m; allowed: 1 mm to 1 km.",
        ),
        (
            ParameterError.of("pattern", "70000 chips", "9", verb="has"),
            "Raw chip pattern cannot have 70000 chips; allowed: 9.",
        ),
        (
            ParameterError.of("photo_scale", "0", "1 to 2"),
            "Photo scale cannot be 0; allowed: 1 to 2.",
        ),
        (
            ParameterError.of("code", "718", "0 to 7", condition="with 3 bits"),
            "Refused: Code is 718; allowed with 3 bits: 0 to 7.",
        ),
        (OccError("There is no picture."), "Refused: There is no picture."),
    ],
)
def test_a_refused_value_is_not_said_to_be_the_present_one(error: OccError, said: str) -> None:
    assert refusal_of(error) == said


def test_an_error_of_a_place_names_the_place_first() -> None:
    error = ParameterError.of("iso", "0", "1 to 2", parameters=("iso",)).within("Frame 5")
    assert str(error) == "Frame 5: iso is 0; allowed: 1 to 2."
    assert sentence_with_label(error) == "Frame 5: ISO speed is 0; allowed: 1 to 2."
    assert error.parameters == ("iso",)
