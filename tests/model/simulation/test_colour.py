"""Pictures of a colour camera: their plan, what they refuse, and what a monochrome one costs."""

import subprocess
import sys

import cv2
import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.mosaic import demosaic
from occ_model.scene.colour_scenes import EFFECTS_OFF
from occ_model.scene.scene import Scene

RAW = {"demosaicing": "none"}


def small(**changes: float | str) -> Scene:
    scene = occ.load_preset("phone-68us-colour").replace(rows=240, panel_height=0.05)
    return scene.replace(**changes)


def test_a_monochrome_picture_loads_nothing_of_colour() -> None:
    code = (
        "import sys, occ_model as occ; occ.decode(occ.render(occ.load_preset('phone-68us')).image, "
        "occ.load_preset('phone-68us')); print([n for n in sys.modules if 'simulation.colour' in n "
        "or 'camera.mosaic' in n or 'scene.csk' in n])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_monochrome_scene_is_written_without_colour() -> None:
    assert "colours" not in Scene().to_toml()
    scene = small()
    assert Scene.from_toml(scene.to_toml()) == scene


def test_unused_parameters_of_colour_change_no_monochrome_picture() -> None:
    plain = occ.load_preset("phone-68us").replace(rows=64)
    unused = plain.replace(crosstalk=0.3, red_gain=2.0, demosaicing="vng", green_code=7)
    assert np.array_equal(occ.render(plain).image, occ.render(unused).image)


@pytest.mark.parametrize(
    "call",
    [
        occ.render, occ.plan, lambda s: occ.decode(np.eye(9), s), occ.column_profile, occ.on_time,
        occ.band_profile, occ.band_depth, lambda s: occ.success_rate(s, images=1),
        lambda s: occ.sweep(s, {"distance": [1.0]}, images=1), occ.limits, occ.accuracy,
        lambda s: occ.transmitter_sketch(s, "arduino-uno"),
    ],
)  # fmt: skip
def test_what_is_of_one_colour_refuses_three(call: object) -> None:
    with pytest.raises(occ.ParameterError, match="one colour of the scene"):
        call(small())  # type: ignore[operator]
    with pytest.raises(occ.ParameterError, match="monochrome camera"):
        call(small(bayer="none"))  # type: ignore[operator]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"bayer": "none", "colour_light": "white"}, "a pattern such as rggb"),
        ({"averaging": "pixel-value"}, "light for a colour camera"),
        ({"light": "lamp"}, "white for a light other than a code"),
        ({"green_code": 1024}, "0 to 1023 with 10 bits"),
    ],
)
def test_contradictory_colour_scenes_are_refused(changes: dict[str, str], sentence: str) -> None:
    with pytest.raises(occ.ParameterError) as refused:
        occ.render_colour(small(**changes))
    assert all(word in str(refused.value) for word in sentence.split())
    with pytest.raises(occ.ParameterError):
        small(**changes).colour("red")


def test_there_are_three_colours() -> None:
    with pytest.raises(occ.ParameterError, match="red, green, blue"):
        small().colour("pink")
    assert small(shown_colour="blue").colour() == small().colour("blue")


@pytest.mark.parametrize(
    ("text", "problem"),
    [("1 2", "2 numbers"), ("1 0 0 1 0 0 0 0 1", "inverted"), ("a" * 9, "not a number"),
     ("0 0 0 0 1 0 0 0 1", "hardly any light"), ("-1 0 0 0 1 0 0 0 1", "outside 0 to 1")],
)  # fmt: skip
def test_a_matrix_that_cannot_be_used_is_refused(text: str, problem: str) -> None:
    with pytest.raises(occ.ParameterError, match=problem):
        small(mixing=text)


def test_the_plan_names_the_effects_of_colour_in_the_order_of_light() -> None:
    frame = occ.render_colour(small(jpeg_quality=90, blue_gain=1.5, point_spread=1.5))
    names = [decision.effect for decision in frame.plan.decisions]
    order = ["led-edges", "defocus", "mixing", "sensor-noise", "white-balance", "demosaicing",
             "jpeg", "chroma"]  # fmt: skip
    assert [name for name in names if name in order] == order
    assert set(order[1:]) <= set(frame.plan.included)
    raw = occ.render_colour(small(jpeg_quality=90, **RAW))
    assert "jpeg" not in raw.plan
    assert [d.why for d in raw.plan.decisions if d.effect == "jpeg"] == ["none in this scene"]
    assert raw.image.ndim == 2


@pytest.mark.parametrize("effect", EFFECTS_OFF)
def test_an_effect_switched_off_leaves_the_picture_of_a_scene_without_it(effect: str) -> None:
    scene = small(crosstalk=0.2, blue_gain=1.5, jpeg_quality=90)
    frame = occ.render_colour(scene, force={effect: False})
    without = occ.render_colour(scene.replace(**EFFECTS_OFF[effect]))
    assert np.array_equal(frame.image, without.image)
    usual = occ.render_colour(scene)
    assert not np.array_equal(frame.image, usual.image)
    (decision,) = (d for d in frame.plan.decisions if d.effect == effect)
    assert effect in usual.plan
    assert effect not in frame.plan
    assert decision.reason.endswith("levels: switched off")
    assert frame.plan.error == pytest.approx(np.hypot(usual.plan.error, decision.estimate))
    with pytest.raises(occ.ParameterError, match="led-edges"):
        occ.render(scene.colour("red"), force={effect: False})


@pytest.mark.parametrize("seed", [11, 12, 13])
def test_estimates_of_colour_are_the_changes_of_pictures(seed: int) -> None:
    random = np.random.default_rng(seed)
    scene = small(
        crosstalk=random.uniform(0.05, 0.4), blue_gain=random.uniform(1.1, 1.8), jpeg_quality=92,
        switching_frequency=random.uniform(3e3, 3e4), exposure_time=random.uniform(2e-5, 2e-4),
    )  # fmt: skip
    quiet = {"sensor-noise": False, "fixed-pattern": False}
    frame = occ.render_colour(scene, force=quiet)
    sizes = {decision.effect: decision.estimate for decision in frame.plan.decisions}
    rows = slice(frame.region.first_row + 16, frame.region.last_row - 16)
    columns = slice(frame.region.first_column + 8, frame.region.last_column - 8)

    def seen(**changes: float | str) -> np.ndarray:
        image = occ.render_colour(scene.replace(**changes), force=quiet).image
        return image[rows, columns].astype(float)

    def rms(change: np.ndarray) -> float:
        return float(np.sqrt((change**2).mean()))

    uncompressed = seen(jpeg_quality=0)
    stretch = 255.0 / np.ptp(uncompressed)
    changes = {
        "mixing": uncompressed - seen(jpeg_quality=0, crosstalk=0.0),
        "white-balance": uncompressed - seen(jpeg_quality=0, blue_gain=1.0),
        "jpeg": seen(chroma="full") - uncompressed,
        "chroma": seen() - seen(chroma="full"),
    }
    for name, change in changes.items():
        assert rms(change) * stretch == pytest.approx(sizes[name], rel=0.25), name


def test_profiles_are_the_means_of_the_picture() -> None:
    for changes in (RAW, {}):
        frame = occ.render_colour(small(**changes))
        rows = slice(frame.region.first_row, frame.region.last_row)
        if frame.image.ndim == 3:
            expected = frame.image[rows].mean(axis=0).T
        else:
            expected = np.full(frame.profiles.shape, np.nan)
            for place, letter in enumerate("rggb"):
                first = rows.start + (rows.start + place // 2) % 2
                own = frame.image[first : rows.stop : 2, place % 2 :: 2]
                expected["rgb".index(letter), place % 2 :: 2] = own.mean(axis=0)
        assert frame.profiles == pytest.approx(expected, nan_ok=True)


@pytest.mark.parametrize("size", [(1, 1), (1, 7), (7, 1), (2, 2), (9, 301)])
def test_pictures_may_have_any_size(size: tuple[int, int]) -> None:
    scene = small(**RAW).replace(rows=size[0], columns=size[1])
    assert occ.render_colour(scene).image.shape == size


def test_a_picture_too_small_to_demosaic_is_refused() -> None:
    with pytest.raises(occ.ParameterError, match="fewer than 4 rows"):
        occ.render_colour(small(rows=3))


@pytest.mark.parametrize("method", ["bilinear", "edge-aware"])
def test_bands_of_rows_are_demosaiced_as_the_whole(method: str) -> None:
    scene = small(demosaicing=method, gamma=1.0)
    raw = np.random.default_rng(8).integers(0, 256, (101, 40), dtype=np.uint8)
    code = getattr(cv2, f"COLOR_BayerRGGB2RGB{'_EA' if method == 'edge-aware' else ''}")
    whole = cv2.demosaicing(raw.astype(np.uint16) * 257, code) / 257.0
    assert np.abs(demosaic(raw, scene) - whole).max() <= 0.51


def test_a_blur_acts_on_light_and_not_on_the_mosaic() -> None:
    # White light: a lens must leave the colours alike, as the filters are behind it.
    scene = small(colour_light="white", crosstalk=0.0, point_spread=2.0, **RAW)
    quiet = {"sensor-noise": False, "fixed-pattern": False}
    image = occ.render_colour(scene, force=quiet).image[100:140, 1000:2000]
    assert np.abs(image[::2].astype(int) - image[1::2]).max() <= 1


def test_what_is_done_without_a_change_is_not_said_to_change_anything() -> None:
    lit = small(
        light="waveform", levels="1 / 1", colour_light="white", illuminance=0.0, jpeg_quality=95
    )
    reasons = {d.effect: d.reason for d in occ.render_colour(lit).plan.decisions}
    for effect in ("demosaicing", "jpeg", "chroma"):
        assert reasons[effect].startswith("no change in this scene, ")
        assert reasons[effect].endswith(": included")
