"""Laws of the rolling shutter's exposure, compared with exact rational arithmetic."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.exposure import lit_fraction
from occ_model.scene.scene import Scene
from occ_model.study.theory import alternating_swing


@pytest.mark.parametrize(
    ("frequency", "exposure", "response"),
    [
        (2000.0, 100e-6, 0.9355),
        (2000.0, 250e-6, 0.6366),
        (2000.0, 500e-6, 0.0),
        (500.0, 488e-6, 0.9049),
        (500.0, 977e-6, 0.6512),
    ],
)
def test_exposure_damps_a_frequency_by_its_sinc(
    frequency: float, exposure: float, response: float
) -> None:
    samples = 4096
    scene = Scene().replace(
        pattern="01",
        switching_frequency=2 * frequency,
        exposure_time=exposure,
        readout_time=1.0 / frequency / samples,
        columns=samples,
    )
    # A square wave's fundamental has the amplitude 2/pi; the exposure leaves |sinc(F t)| of it.
    fundamental = abs(np.fft.rfft(lit_fraction(scene))[1]) / (samples / 2)
    assert fundamental / (2 / np.pi) == pytest.approx(response, abs=6e-5)


@pytest.mark.parametrize("chips", [0.3, 0.68, 1.0, 1.36, 1.94, 2.0, 2.6, 3.0, 3.7, 4.0, 5.25])
def test_alternating_chips_keep_the_swing_that_theory_states(chips: float) -> None:
    scene = Scene().replace(
        pattern="01", switching_frequency=1e4, exposure_time=chips * 1e-4, readout_time=1e-6,
        columns=400,
    )  # fmt: skip
    assert np.ptp(lit_fraction(scene)) == pytest.approx(alternating_swing(scene), abs=1e-9)


def test_every_run_shows_beyond_the_period_at_10_khz() -> None:
    scene = occ.load_preset("phone-136us").replace(switching_frequency=10e3)
    lit = lit_fraction(scene)
    assert scene.camera.exposure_time > scene.transmitter.switching_period
    assert lit.max() == 1.0  # the header's three ones last longer than the exposure
    assert lit.min() == 0.0  # and so do two zeros


def test_scenes_of_the_same_light_share_its_exposure() -> None:
    scene = occ.load_preset("phone-136us")
    lit = lit_fraction(scene)
    assert lit_fraction(scene.replace(distance=0.7, iso=200.0, yaw=0.1)) is lit
    for change in (
        {"code": 5}, {"switching_frequency": 3e3}, {"exposure_time": 1e-4},
        {"readout_time": 9e-6}, {"columns": 3000}, {"start_time": 1e-4},
    ):  # fmt: skip
        assert not np.array_equal(lit_fraction(scene.replace(**change)), lit)
    with pytest.raises(ValueError, match="read-only"):
        lit[0] = 1.0
