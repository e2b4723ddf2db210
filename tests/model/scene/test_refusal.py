"""A refused value is data; its sentence has the parameter's name, or the label of its field."""

import pickle

import pytest

from occ_model.errors import OccError, ParameterError
from occ_model.scene.parameter_kinds import Parameter
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.refusal import labelled, refusal_of

WRONG = ("hex:#", None, -1e99, "2" * 10_000)


def refused(declared: Parameter, value: object) -> ParameterError:
    with pytest.raises(ParameterError) as caught:
        declared.check(value)
    return caught.value


@pytest.mark.parametrize("declared", PARAMETERS.values(), ids=lambda declared: declared.name)
def test_every_parameters_refusal_is_its_data_in_words(declared: Parameter) -> None:
    for wrong in WRONG:
        error = refused(declared, wrong)
        assert error.refused.parameter == declared.name
        assert str(error).startswith(f"{declared.name} {error.refused.verb} {error.refused.value}")
        assert str(error).endswith(f"; allowed: {error.refused.allowed}.")
        assert labelled(error) == str(error).replace(declared.name, declared.label, 1)
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
    assert labelled(error) == "Frame 5: ISO speed is 0; allowed: 1 to 2."
    assert error.parameters == ("iso",)
