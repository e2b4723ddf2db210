"""The cause that is stated is the scene's, and the remedy that is offered helps."""

import math
from typing import Any

import numpy as np
import pytest
from amount import amount
from scene_values import presets_of_codes

import occ_model as occ
from occ_model.camera.photometry import level_values
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.scene.scene import Scene
from occ_model.study.cause.cause import cause_of
from occ_model.study.cause.suspects import (
    reads_two_headers,
    suspect_long_exposure,
    suspect_other_light,
)

SMALL = {"rows": 400}
NULL = "the null at 14.7 kHz"


@pytest.mark.parametrize(
    ("changes", "decoder", "what"),
    [
        ({"switching_frequency": 20e3}, "threshold", f"beyond {NULL}"),
        ({"switching_frequency": 60e3}, "equalizer", f"beyond {NULL}"),
        ({"switching_frequency": 2e3}, "threshold", "too few chips in view"),
        ({"read_noise": 400.0, "iso": 400.0}, "threshold", "shot and read noise"),
        (
            {"luminance": 100.0, "illuminance": 1.0, "iso": 50.0, "enhancement": "none"},
            "sequence", "too dark",
        ),
        ({"iso": 6400.0, "illuminance": 30e3}, "threshold", "overexposed"),
        ({"iso": 12800.0}, "threshold", "overexposed"),
        ({"iso": 12800.0}, "matched", "overexposed"),
        ({"iso": 6400.0, "enhancement": "none"}, "equalizer", "overexposed"),
        ({"full_well": 100.0, "enhancement": "none"}, "sequence", "overexposed"),
        (
            {"readout_time": 80e-6, "switching_frequency": 20e3}, "threshold",
            "chips are narrower than a column",
        ),
    ],
)  # fmt: skip
def test_the_remedy_that_is_offered_helps(changes: dict[str, Any], decoder: str, what: str) -> None:
    scene = occ.load_preset("phone-136us").replace(**SMALL, **changes)
    assert occ.success_rate(scene, 3, decoder) < 100.0
    cause = cause_of(scene, decoder)
    assert cause is not None
    assert cause.what == what
    assert cause.is_overexposed == (what == "overexposed")
    if cause.remedy is None:
        assert what == "shot and read noise"  # of this scene, whatever the decoder
        return
    helped = scene.replace(**cause.remedy.changes)
    again = cause_of(helped, cause.remedy.decoder or decoder)
    assert again is None or again.what != what
    if "In addition" not in cause.why:
        assert occ.success_rate(helped, 3, cause.remedy.decoder or decoder) == 100.0


def test_overexposure_is_not_the_cause_if_the_picture_is_read_or_fails_without_it() -> None:
    white = occ.load_preset("phone-136us").replace(**SMALL, iso=6400.0)
    assert occ.column_profile(white).max() == 255.0
    assert cause_of(white, "threshold") is None
    fast = white.replace(switching_frequency=20e3)
    assert occ.success_rate(fast.replace(iso=400.0), 3, "threshold") < 50.0
    assert cause_of(fast, "threshold").what == f"beyond {NULL}"
    assert not cause_of(fast, "threshold").is_overexposed


@pytest.mark.parametrize(
    ("frequency", "what"),
    [
        (14.3e3, f"410 Hz below {NULL}"),
        (14.7e3, f"at {NULL}"),
        (15e3, f"290 Hz above {NULL}"),
        (20e3, f"beyond {NULL}"),
    ],
)
def test_the_null_is_stated_with_the_distance_from_it(frequency: float, what: str) -> None:
    scene = occ.load_preset("phone-136us").replace(**SMALL, switching_frequency=frequency)
    cause = cause_of(scene, "threshold")
    assert cause.what == what
    assert cause.remedy.decoder == "matched"
    # The same frequency is not a cause where the picture is read.
    assert cause_of(scene, "matched") is None


def test_percentages_near_100_are_written_without_an_exponent() -> None:
    scene = occ.load_preset("phone-136us").replace(switching_frequency=1.001 / 136e-6)
    exposed = suspect_long_exposure(scene)
    assert exposed is not None
    assert exposed.why.endswith("leaves 100 % of the swing of alternating chips.")
    outshone = suspect_other_light(scene.replace(illuminance=1e8, iso=1.0))
    assert outshone is not None
    assert outshone.why == "The dark panel has 100 % of the lit one's level."


@pytest.mark.parametrize("enhancement", ["equalization", "none"])
def test_a_panel_too_small_for_the_brightest_pixels_is_not_found(enhancement: str) -> None:
    """Stripes are clearly visible, but the receiver takes the whole picture for the panel."""
    scene = occ.load_preset("phone-68us").replace(panel_height=0.002, enhancement=enhancement)
    picture = occ.render(scene).image
    assert occ.decode(picture, scene).code is None
    cause = cause_of(scene, "threshold")
    assert cause.what == "the panel is not found"
    assert cause.why.startswith(
        "The receiver marks the brightest 5 % of the pixels, but the panel covers 0.065 %"
    )
    helped = scene.replace(**cause.remedy.changes)
    assert occ.decode(picture, helped).code == scene.transmitter.code
    assert cause_of(scene.replace(panel_height=0.2), "threshold") is None


def test_chips_are_stated_as_needed_only_if_no_picture_is_read_with_fewer() -> None:
    """At 5 m the 33 chips in view contain both headers in some pictures, and a packet in all."""
    far = occ.load_preset("phone-136us").replace(distance=5.0)
    assert 0.0 < occ.success_rate(far, 20, "threshold") < 100.0
    assert occ.success_rate(far, 3, "matched") == 100.0
    unread = far.replace(start_time=1e-3)
    assert occ.decode(occ.render(unread).image, unread).code is None
    cause = cause_of(unread, "threshold")
    assert cause.why == (
        "The panel's image has room for 33 of the 48 chips of two packets, so not every "
        "picture shows both headers."
    )
    assert cause_of(far, "matched") is None
    less = cause_of(far.replace(distance=9.0), "matched")
    assert less.why == "The panel's image has room for 18 of the 24 chips of a packet."
    assert occ.success_rate(far.replace(distance=9.0), 5, "matched") == 0.0


def test_two_headers_are_stated_as_needed_only_for_framings_that_need_them() -> None:
    scene = occ.load_preset("phone-68us")
    assert reads_two_headers(scene, "threshold")
    assert not reads_two_headers(scene, "matched")
    assert not reads_two_headers(scene.replace(line_code="manchester", framing="raw"), "threshold")


def test_a_scene_that_is_read_has_no_cause() -> None:
    for preset in presets_of_codes():
        for decoder in QUICK_DECODERS:
            assert cause_of(occ.load_preset(preset).replace(**SMALL), decoder) is None
    assert cause_of(occ.load_preset("phone-136us").replace(pattern="10"), "threshold") is None


def test_no_cause_is_stated_if_removing_everything_does_not_make_it_readable() -> None:
    dark = occ.load_preset("phone-136us").replace(**SMALL, luminance=0.0)
    assert cause_of(dark, "threshold") is None


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"offset_x": 50.0}, "the panel is out of the picture"),
        ({"distance": 5e3}, "the panel is smaller than a pixel"),
    ],
)
def test_a_panel_that_no_column_shows_is_out_of_the_picture_or_too_small(
    changes: dict[str, Any], what: str
) -> None:
    cause = cause_of(occ.load_preset("phone-68us").replace(**SMALL, **changes), "threshold")
    assert (cause.what, cause.remedy) == (what, None)


def test_an_effect_is_stated_if_it_alone_spoils_the_picture() -> None:
    scene = occ.load_preset("phone-68us").replace(**SMALL, edge_time=300e-6)
    cause = cause_of(scene, "threshold")
    assert cause.what == "LED rise and fall"
    assert occ.success_rate(scene, 3, "threshold", force={"led-edges": False}) == 100.0


def test_causes_that_are_needed_together_are_stated_together() -> None:
    scene = occ.load_preset("phone-136us").replace(**SMALL, iso=12800.0, distance=9.0)
    for alone in ({"iso": 400.0}, {"distance": 1.2}):
        assert occ.success_rate(scene.replace(**alone), 3, "threshold") < 50.0
    cause = cause_of(scene, "threshold")
    assert cause.what == "overexposed"
    assert cause.why.endswith("In addition: too few chips in view.")


def test_more_bits_than_the_matched_decoder_compares_are_left_to_the_sequence_decoder() -> None:
    scene = occ.load_preset("phone-136us").replace(
        **SMALL, payload="text:HELLO", line_code="manchester", framing="preamble", distance=0.6
    )
    assert occ.success_rate(scene, 3, "matched") == 0.0
    cause = cause_of(scene, "matched")
    assert cause.what == "too many bits to compare"
    assert occ.success_rate(scene, 3, cause.remedy.decoder) == 100.0


def remove_cause(cause: str, scene: Scene) -> list[Scene]:
    """Return the scene without a cause, in several versions made independently of the program."""
    camera, lit = scene.camera, float(level_values(scene)[1])
    frequency = scene.transmitter.switching_frequency

    def light(factor: float, **changes: Any) -> Scene:
        return scene.replace(
            luminance=factor * scene.transmitter.luminance,
            illuminance=factor * scene.surroundings.illuminance,
            **changes,
        )

    to_level = (150.0 / lit) ** camera.gamma
    short = 0.8 / frequency
    slower = [scene.replace(switching_frequency=part * frequency) for part in (0.8, 0.5, 0.3)]
    ways = {
        "overexposed": [light(to_level), scene.replace(iso=max(to_level * camera.iso, 1.0))],
        "too dark": [scene.replace(iso=camera.iso * to_level), light(to_level)],
        "too few chips": [scene.replace(distance=scene.pose.distance / part) for part in (2, 4, 8)],
        "narrower": slower,
        "null": [light(camera.exposure_time / short, exposure_time=short), *slower],
        "exposed for": [light(camera.exposure_time / short, exposure_time=short), *slower],
        "chips of": slower,
        "noise": [light(64.0, iso=max(camera.iso / 64.0, 1.0)), scene.replace(read_noise=0.0)],
        "enhanced": [scene.replace(enhancement="none")],
        "other sources": [scene.replace(luminance=30.0 * scene.transmitter.luminance)],
    }
    (found,) = (scenes for key, scenes in ways.items() if key in cause)
    return found


def unread_scene(random: np.random.Generator) -> tuple[Scene, str]:
    """Choose settings at which something is often wrong."""
    scene = occ.load_preset(str(random.choice(["phone-68us", "phone-136us", "tablet-61us"])))
    changes: dict[str, Any] = {"rows": 200, "start_time": float(random.uniform(0.0, 2e-3))}
    for name, low, high in (
        ("iso", 50.0, 51200.0), ("switching_frequency", 3e3, 40e3), ("distance", 0.4, 4.0),
        ("luminance", 5.0, 2e4),
    ):  # fmt: skip
        if random.random() < 0.4:
            changes[name] = math.exp(random.uniform(math.log(low), math.log(high)))
    changes["enhancement"] = str(random.choice(["none", "stretch", "equalization"]))
    decoder = str(random.choice(["threshold", "matched", "sequence"]))
    return scene.replace(**changes), decoder


def is_read(scene: Scene, decoder: str) -> bool:
    read = occ.decode(occ.render(scene).image, scene, decoder)
    return tuple(read.bits.tolist()) == scene.transmitter.payload_bits and read.failure is None


def test_without_its_first_cause_a_random_picture_is_read() -> None:
    """Checked on whole pictures with a single cause, which is removed independently."""
    random = np.random.default_rng(5)
    wrong, asked = [], 0
    while asked < amount(15, 150):
        scene, decoder = unread_scene(random)
        if is_read(scene, decoder):
            continue
        cause = cause_of(scene, decoder)
        if cause is None or "In addition" in cause.why:
            continue
        asked += 1
        if not any(is_read(other, decoder) for other in remove_cause(cause.what, scene)):
            wrong.append((cause, decoder, scene))
    assert len(wrong) <= 0.1 * asked
