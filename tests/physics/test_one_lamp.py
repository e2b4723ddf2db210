"""One lamp of 239 Hz, lit for 30 % of the time: all who speak of its bars give the same numbers."""

import math

import numpy as np
import pytest

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.cli import main
from occ_model.scene.scene import SimulationSettings
from occ_model.study.bands.answer import bars_answer
from occ_model.study.spectrum import profile_spectrum

_PERIODS = 7  # in a picture
_LAMP = occ.load_preset("phone-136us").replace(
    light="lamp", lamp_frequency=239.0, duty=0.3, exposure_time=1 / 100, illuminance=0.0,
    averaging="light", gamma=1.0, columns=3456, rows=400, panel_height=5.0, panel_width=5.0,
    readout_time=_PERIODS / 239.0 / 3456, iso=20.0, luminance=200.0, full_well=1e9,
)  # fmt: skip
# 2.39 periods: at most 0.3 of one beyond two whole ones, and at least nothing of it.
_DEPTH = 0.3 / (2.39 * 0.3)


def _depth(profile: FloatArray) -> float:
    return float(np.ptp(profile) / profile.mean())


def test_every_door_gives_the_closed_form_s_depth(capsys: pytest.CaptureFixture[str]) -> None:
    picture = occ.render(_LAMP, tolerance=math.inf).camera_image
    profile = occ.column_profile(_LAMP)
    bars = occ.band_depth(_LAMP)
    main(["bands", "--lamp", "239Hz 30%", "--shutter", "1/100"])
    assert "At 1/100 s they are 41.8 % of the mean light" in capsys.readouterr().out
    level = 1.0 / float(picture.mean())  # which rounding to whole levels can change each end by
    for door, depth, error in (
        ("closed form of a pulse", occ.pulse_depth(0.3, 2.39).peak_to_peak, 1e-12),
        ("light", bars.peak_to_peak, 1e-12),
        ("answer", bars_answer(_LAMP).depth, 1e-12),
        ("columns", bars.columns.peak_to_peak, 1e-3),
        ("profile", _depth(profile), 1e-3),
        ("pixel values", bars.pixel.peak_to_peak, 1e-3),
        ("picture", _depth(picture.mean(axis=0)), level),
    ):
        assert depth == pytest.approx(_DEPTH, abs=error), door


def test_spectrum_columns_and_film_agree_on_the_lamp_s_frequency() -> None:
    profile = occ.column_profile(_LAMP)
    spectrum = profile_spectrum(profile, _LAMP)
    assert spectrum.frequencies[spectrum.amplitudes.argmax()] == pytest.approx(239.0, rel=1e-9)
    # The sine of a pulse of duty D, behind the exposure: 2 sinc(D) sinc(F t) of the mean.
    left = 2.0 * np.sinc(0.3) * abs(np.sinc(2.39))
    assert spectrum.amplitudes.max() / profile.mean() == pytest.approx(left, rel=1e-3)
    bars = occ.band_depth(_LAMP)
    assert bars.frequency == 239.0
    assert bars.period == pytest.approx(3456 / _PERIODS)
    assert bars_answer(_LAMP).columns == pytest.approx(3456 / _PERIODS)
    # 239 Hz at 30 frames a second: a cycle less than eight a frame, so that bars come back in 1 s.
    frames = list(occ.render_video(_LAMP, 3, settings=SimulationSettings(tolerance=math.inf)))
    phases = [float(np.angle(np.fft.rfft(frame.image.mean(axis=0))[_PERIODS])) for frame in frames]
    moved = np.diff(phases) / (2.0 * np.pi)
    of_film = next(each for each in bars_answer(_LAMP).rates if each.name == "30")
    assert of_film.frequency == pytest.approx(1.0)
    # Within what grey levels leave of the phase.
    assert np.abs(moved - np.round(moved)) == pytest.approx(of_film.frequency / 30.0, rel=5e-3)
