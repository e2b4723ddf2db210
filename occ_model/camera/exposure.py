"""The rolling shutter: how long the LED is on during each column's exposure.

Column ``i`` is exposed over [t_0 + i t_r, t_0 + i t_r + t]. The time that the LED is on during it
is a difference of two values of the waveform's running integral. This takes the same work for any
ratio of exposure time to switching period, without sampling in time or a loop over chips.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.light.cosine import Cosine
from occ_model.light.sent import Light, PiecewiseLight, light_of
from occ_model.light.times import Duration, PhasesInPeriod, count_each, count_phases
from occ_model.scene.scene import Scene

_NO_SHIFT = Fraction(0)


def column_phases(
    scene: Scene,
    rate: Fraction,
    period: int,
    shift: Fraction = _NO_SHIFT,
    columns: int | None = None,
) -> PhasesInPeriod:
    """Return where in a period each column's exposure starts.

    ``rate``: units, such as chips, per second; ``period``: their number in a period. Start
    and step are reduced to one period exactly, as fractions; the columns follow in floating point.
    ``shift`` is added to all starts. The result is read-only.
    """
    count = scene.camera.columns if columns is None else columns
    # Fewer columns are often requested, so that at least the picture's are computed and cached.
    starts = _column_starts(
        rate,
        scene.camera.readout_time,
        scene.model.start_time,
        period,
        shift,
        max(count, scene.camera.columns),
    )
    return starts if count == len(starts.whole) else starts.first(count)


@lru_cache(maxsize=8)
def _column_starts(
    rate: Fraction,
    readout_time: float,
    start_time: float,
    period: int,
    shift: Fraction,
    columns: int,
) -> PhasesInPeriod:
    """Return the phases, cached by all on which they depend, which excludes the exposure time."""
    start = (Fraction(start_time) * rate + shift) % period
    phases = count_phases(start, _step(readout_time, rate, period), period, columns)
    phases.whole.flags.writeable = phases.fraction.flags.writeable = False
    return phases


@lru_cache(maxsize=8)
def _step(readout_time: float, rate: Fraction, period: int) -> Fraction:
    return Fraction(readout_time) * rate % period


def lit_fraction(scene: Scene) -> FloatArray:
    """Return the mean light of each column's exposure, 1 being the panel fully lit; read-only.

    For chips, it is the fraction of the exposure with the LED on, t_on / t.
    """
    camera = scene.camera
    return _lit_fraction(
        light_of(scene.transmitter),
        camera.exposure_time,
        camera.readout_time,
        camera.columns,
        scene.model.start_time,
    )


@lru_cache(maxsize=8)
def _lit_fraction(
    light: Light, exposure_time: float, readout_time: float, columns: int, start_time: float
) -> FloatArray:
    """Return the fraction, cached by all on which it depends, which excludes the pose."""
    if isinstance(light, Cosine):
        lit = light.means(
            Fraction(start_time), Fraction(readout_time), columns, Fraction(exposure_time)
        )
    else:
        period = light.waveform.period
        starts = _column_starts(light.rate, readout_time, start_time, period, _NO_SHIFT, columns)
        lit = _lit_from(light, starts, exposure_time)
    lit.flags.writeable = False
    return lit


def _lit_from(light: PiecewiseLight, starts: PhasesInPeriod, exposure_time: float) -> FloatArray:
    period = light.waveform.period
    exposure = Duration.of(Fraction(exposure_time) * light.rate, period)
    lit = light.waveform.light_in(starts, exposure)
    lit /= exposure.in_units(period)
    return np.clip(lit, 0.0, 1.0, out=lit)


def phases_of_images(
    scene: Scene, start_times: Sequence[float], light: PiecewiseLight, shift: Fraction = _NO_SHIFT
) -> PhasesInPeriod:
    """Return where in the light's period each column's exposure starts, for several images.

    The arrays have the shape (images, columns). ``shift``, in units of the light, is added.
    """
    period, camera = light.waveform.period, scene.camera
    starts = [(Fraction(time) * light.rate + shift) % period for time in start_times]
    return count_each(
        starts, _step(camera.readout_time, light.rate, period), period, camera.columns
    )


def lit_fractions(scene: Scene, start_times: Sequence[float]) -> FloatArray:
    """Return :func:`lit_fraction` for images that start at other times: (images, columns)."""
    light, camera = light_of(scene.transmitter), scene.camera
    if isinstance(light, Cosine):
        step, exposure = Fraction(camera.readout_time), Fraction(camera.exposure_time)
        return np.array(
            [light.means(Fraction(time), step, camera.columns, exposure) for time in start_times]
        )
    return _lit_from(light, phases_of_images(scene, start_times, light), camera.exposure_time)


def on_time(scene: Scene) -> FloatArray:
    """Return how long the LED is on during each column's exposure, t_on(i).

    For a light of several levels, it is the integral of the light: seconds times level, fully lit
    being 1. A lamp on the mains exceeds its mean, 1, in part of each cycle.

    Returns
    -------
    ndarray of float64, shape (columns,)
        Seconds, for chips from 0 to the exposure time; t_off is the rest of the exposure time.
    """
    return lit_fraction(scene) * scene.camera.exposure_time
