"""The marks of a slider stand where the picture changes in kind."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.teaching.marked_values import marked_values


def test_the_band_model_ends_and_stripes_vanish_at_the_marks() -> None:
    scene = occ.load_preset("phone-136us").replace(pattern="10")
    for name in ("switching_frequency", "exposure_time"):
        equal, null = marked_values(scene, name)
        longer = scene.replace(**{name: equal.value * 1.001})
        occ.band_lengths(scene.replace(**{name: equal.value * 0.999}))
        with pytest.raises(occ.BandModelUndefined):
            occ.band_lengths(longer)
        assert np.ptp(occ.column_profile(scene.replace(**{name: null.value}))) < 0.1
    assert marked_values(scene, "distance") == ()


@pytest.mark.parametrize("parameter", ["exposure_time", "switching_frequency"])
@pytest.mark.parametrize("pattern", ["10", "1110", "1010", "110100", ""])
def test_bars_vanish_at_their_mark_and_not_before(pattern: str, parameter: str) -> None:
    scene = occ.load_preset("phone-136us").replace(pattern=pattern, switching_frequency=8192.0)
    mark = marked_values(scene, parameter)[-1]
    assert mark.label == "no bars"
    assert occ.band_depth(scene.replace(**{parameter: mark.value})).peak_to_peak < 1e-12
    for part in (0.3, 0.5, 0.9):
        assert occ.band_depth(scene.replace(**{parameter: part * mark.value})).peak_to_peak > 0.005


def test_only_a_code_has_a_mark_at_two_chips() -> None:
    scene = occ.load_preset("phone-136us")
    for pattern, labels in (
        ("", ["t = t_LED", "null", "no bars"]),
        ("10", ["t = t_LED", "no bars"]),
    ):
        marks = marked_values(scene.replace(pattern=pattern), "exposure_time")
        assert [mark.label for mark in marks] == labels


def test_a_scene_whose_packet_cannot_be_made_has_the_marks_of_its_timing() -> None:
    scene = occ.load_preset("phone-136us").replace(line_code="nrz", framing="c-ook")
    with pytest.raises(occ.ParameterError, match="limits no run"):
        occ.packet(scene)
    assert [mark.label for mark in marked_values(scene, "exposure_time")] == ["t = t_LED", "null"]
