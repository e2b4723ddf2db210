"""Sentences of the model name parameters by the labels in the window."""

import pytest

from occ_gui.scene.wording import with_labels
from occ_model.errors import ParameterError
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


def test_no_label_is_a_name_itself() -> None:
    for declared in PARAMETERS.values():
        assert with_labels(declared.label) == declared.label
