"""Settings of many photos are refused by their names before any photo is read."""

import re
from typing import Any

import pytest

import occ_model as occ
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.reading.scan_axis import SCAN_AXES


@pytest.mark.parametrize("name", ["estimate", "sent", "scan_axis", "channel"])
def test_a_word_that_is_none_is_refused_with_its_setting(name: str) -> None:
    wrong: dict[str, Any] = {name: "nobody"}
    with pytest.raises(occ.ParameterError, match=rf"{re.escape(name)}.*nobody"):
        MatchSettings(occ.Scene(), **wrong).check()


def test_allowed_words_pass_and_no_scene_does_not() -> None:
    MatchSettings(occ.Scene(), "switching_frequency", "read", scan_axis=SCAN_AXES[-1]).check()
    with pytest.raises(occ.ParameterError):
        MatchSettings(None).check()  # type: ignore[arg-type]
