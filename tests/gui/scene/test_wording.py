"""Sentences of the model name parameters by the labels in the window."""

import pytest

from occ_gui.scene.wording import refusal_of, with_labels
from occ_model.errors import ParameterError
from occ_model.scene.parameter_kinds import Parameter
from occ_model.scene.parameters import PARAMETERS, quantity


@pytest.mark.parametrize("name", ["switching_frequency", "iso", "f_number"])
def test_a_value_out_of_range_is_named_by_its_label(name: str) -> None:
    declared = quantity(name)
    with pytest.raises(ParameterError) as caught:
        declared.check(1e30)
    sentence = with_labels(str(caught.value))
    assert sentence.startswith(declared.label)
    assert declared.name not in sentence.replace(declared.label, "")


@pytest.mark.parametrize(
    ("sentence", "messages"),
    [
        ("There is no picture.", "There is no picture."),
        ("code is 7; bits says 2.", "Code is 7; bits says 2."),
        ("The exposure_time is too long.", "The “Exposure time” is too long."),
        ("A file_name stays.", "A file_name stays."),
        ("", ""),
    ],
)
def test_only_names_of_parameters_are_replaced(sentence: str, messages: str) -> None:
    assert with_labels(sentence) == messages


@pytest.mark.parametrize(
    ("sentence", "said"),
    [
        (
            "distance is 0 m; allowed: 1 mm to 1 km.",
            "Distance cannot be 0 m; allowed: 1 mm to 1 km.",
        ),
        (
            "pattern has 70000 chips; allowed: 9.",
            "Raw chip pattern cannot have 70000 chips; allowed: 9.",
        ),
        ("The bits are '01'; allowed: 10.", "The bits cannot be '01'; allowed: 10."),
        ("photo_scale is 0; allowed: 1 to 2.", "Photo scale cannot be 0; allowed: 1 to 2."),
        (
            "code is 718; allowed with 3 bits: 0 to 7.",
            "Refused: Code is 718; allowed with 3 bits: 0 to 7.",
        ),
    ],
)
def test_a_refused_value_is_not_said_to_be_the_present_one(sentence: str, said: str) -> None:
    assert refusal_of(sentence) == said


@pytest.mark.parametrize("declared", PARAMETERS.values(), ids=lambda declared: declared.name)
def test_every_parameters_refusal_says_what_it_cannot_be(declared: Parameter) -> None:
    for wrong in ("hex:#", None, -1e99, "2" * 10_000):
        with pytest.raises(ParameterError) as caught:
            declared.check(wrong)
        assert refusal_of(str(caught.value)).startswith(f"{declared.label} cannot ")


def test_no_label_is_a_name_itself() -> None:
    for declared in PARAMETERS.values():
        assert with_labels(declared.label) == declared.label
