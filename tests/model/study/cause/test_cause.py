"""The cause that is named is that of the scene, and the step that is offered helps."""

from typing import Any

import pytest

import occ_model as occ
from occ_model.study.cause import cause_of

SMALL = {"rows": 400}


@pytest.mark.parametrize(
    ("changes", "decoder", "what"),
    [
        ({"switching_frequency": 20e3}, "threshold", "beyond the null at 14.7 kHz"),
        ({"switching_frequency": 60e3}, "equalizer", "beyond the null at 14.7 kHz"),
        ({"switching_frequency": 2e3}, "threshold", "too few chips in view"),
        ({"read_noise": 200.0, "luminance": 400.0}, "threshold", "too much noise"),
        ({"read_noise": 300.0, "luminance": 60.0}, "equalizer", "too much noise"),
        ({"luminance": 0.2, "illuminance": 1.0, "enhancement": "none"}, "threshold", "too dark"),
        ({"iso": 6400.0, "illuminance": 30e3}, "threshold", "all is white"),
        (
            {"readout_time": 80e-6, "switching_frequency": 20e3}, "threshold",
            "chips are narrower than a column",
        ),
    ],
)  # fmt: skip
def test_the_step_that_is_offered_helps(changes: dict[str, Any], decoder: str, what: str) -> None:
    scene = occ.load_preset("phone-136us").replace(**SMALL, **changes)
    assert occ.success_rate(scene, 3, decoder) < 50.0
    cause = cause_of(scene, decoder)
    assert cause.what == what
    helped = scene.replace(**cause.step.changes)
    again = cause_of(helped, cause.step.decoder or decoder)
    assert again is None or again.what != what
    if what in ("too few chips in view", "beyond the null at 14.7 kHz", "too much noise"):
        assert occ.success_rate(helped, 3, cause.step.decoder or decoder) == 100.0


@pytest.mark.parametrize("enhancement", ["equalization", "none"])
def test_a_panel_too_small_for_the_brightest_pixels_is_not_found(enhancement: str) -> None:
    """Stripes are plain to see, and the receiver takes the whole picture for the panel."""
    scene = occ.load_preset("phone-68us").replace(panel_height=0.002, enhancement=enhancement)
    picture = occ.render(scene, noise="reused").image
    found = occ.decode(picture, scene)
    assert found.code is None
    cause = cause_of(scene, "threshold", found.region)
    assert cause.what == "the panel is not found"
    assert cause.why.startswith("The brightest 5 % of the pixels mark it, but it covers 0.065 %")
    helped = scene.replace(**cause.step.changes)
    assert occ.decode(picture, helped).code == scene.transmitter.code
    taller = scene.replace(panel_height=0.08)
    found = occ.decode(occ.render(taller, noise="reused").image, taller)
    assert cause_of(taller, "threshold", found.region) is None


def test_chips_are_called_needed_only_where_no_picture_is_read_with_fewer() -> None:
    """At 5 m the 33 chips in view hold both headers in some pictures, and a packet in all."""
    far = occ.load_preset("phone-136us").replace(distance=5.0)
    assert 0.0 < occ.success_rate(far, 20, "threshold") < 100.0
    assert occ.success_rate(far, 3, "matched") == 100.0
    cause = cause_of(far, "threshold")
    assert cause.why == (
        "33 of the 48 chips of two packets are in view, and so both headers not in every picture: "
        "come closer, or raise the frequency."
    )
    assert cause_of(far, "matched") is None
    less = cause_of(far.replace(distance=9.0), "matched")
    assert "18 of the 24 chips of a packet are in view: " in less.why
    assert occ.success_rate(far.replace(distance=9.0), 5, "matched") == 0.0


def test_a_scene_that_is_read_has_no_cause() -> None:
    for preset in occ.presets():
        for decoder in occ.decoders():
            assert cause_of(occ.load_preset(preset), decoder) is None
    assert cause_of(occ.load_preset("phone-136us").replace(pattern="10"), "threshold") is None


def test_more_bits_than_the_matched_decoder_compares_are_left_to_the_sequence_decoder() -> None:
    scene = occ.load_preset("phone-136us").replace(
        **SMALL, payload="text:HELLO", line_code="manchester", framing="preamble", distance=0.6
    )
    assert occ.success_rate(scene, 3, "matched") == 0.0
    cause = cause_of(scene, "matched")
    assert cause.what == "too many bits to compare"
    assert occ.success_rate(scene, 3, cause.step.decoder) == 100.0
