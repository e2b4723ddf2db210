"""The rolling shutter: how long each column sees the panel lit.

Column ``i`` is exposed over [t_0 + i t_r, t_0 + i t_r + t]. The time that the LED is on within it
is a difference of two values of the waveform's running integral: the same work for any ratio of
exposure time to switching period, with no sampling in time and no loop over chips.
"""

from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips
from occ_model.transmitter.waveform import Duration, Phases, Waveform

_AT_ONCE = Fraction(0)


def column_phases(
    scene: Scene, period: int, shift: Fraction = _AT_ONCE, columns: int | None = None
) -> Phases:
    """Return the place in the sent period where each column's exposure starts.

    The start and the step from column to column are reduced to one period in exact arithmetic,
    as fractions; the columns then follow in floating point. The step is split in whole chips, a
    part short enough (24 bits) that its product with any column number is exact, and a remainder
    below 1e-7 chips, so that the error does not grow with the column: about 2e-16 chips after a
    million columns, however many chips a period has.

    Parameters
    ----------
    scene
        The scene.
    period
        The number of chips of one sent period.
    shift
        Chips added to all starts.
    columns
        Number of columns, by default those of the camera.

    Returns
    -------
    Phases, shape (columns,)
    """
    frequency = Fraction(scene.transmitter.switching_frequency)
    start = (Fraction(scene.model.start_time) * frequency + shift) % period
    step = Fraction(scene.camera.readout_time) * frequency % period
    return _phases(start, step, period, scene.camera.columns if columns is None else columns)


def cycle_phases(scene: Scene, frequency: float, delay: Fraction) -> FloatArray:
    """Return the phase of a periodic signal at a delay after each column's start, in cycles.

    Parameters
    ----------
    scene
        The scene.
    frequency
        Of the signal, in Hz.
    delay
        In seconds.

    Returns
    -------
    ndarray of float64, shape (columns,), from 0 to below 1
    """
    cycles = Fraction(frequency)
    start = (Fraction(scene.model.start_time) + delay) * cycles % 1
    step = Fraction(scene.camera.readout_time) * cycles % 1
    return _phases(start, step, 1, scene.camera.columns).fraction


def _phases(start: Fraction, step: Fraction, period: int, count: int) -> Phases:
    """Count up from ``start`` by ``step``, both within one period."""
    start_chip, step_chip = int(start), int(step)
    within = step - step_chip
    coarse = float(np.float32(float(within)))
    fine = float(within - Fraction(coarse))

    column = np.arange(count, dtype=np.float64)
    position = column * coarse
    chip = np.floor(position)
    fraction = (position - chip) + (column * fine + float(start - start_chip))
    carry = np.floor(fraction)
    fraction -= carry
    # A fraction just below zero rounds up to a whole chip when that chip is taken away from it.
    over = fraction >= 1.0
    fraction[over] = 0.0
    chip += column * step_chip
    chip += carry + over + start_chip
    # Exact: a quotient of whole numbers this small never rounds up to a whole number.
    chip -= period * np.floor(chip / period)
    return Phases(chip.astype(np.int64), fraction)


def lit_fraction(scene: Scene) -> FloatArray:
    """Return the share of each column's exposure in which the LED is on, t_on / t.

    Returns
    -------
    ndarray of float64, shape (columns,), from 0 to 1
    """
    waveform = Waveform(sent_chips(scene.transmitter))
    frequency = Fraction(scene.transmitter.switching_frequency)
    exposure = Duration.of(Fraction(scene.camera.exposure_time) * frequency, waveform.period)
    lit = waveform.lit_chips(column_phases(scene, waveform.period), exposure)
    lit /= exposure.in_chips(waveform.period)
    return np.clip(lit, 0.0, 1.0, out=lit)


def on_time(scene: Scene) -> FloatArray:
    """Return the time that the LED is on while each column is exposed, t_on(i).

    Returns
    -------
    ndarray of float64, shape (columns,)
        Seconds, from 0 to the exposure time; t_off is the exposure time less this.
    """
    return lit_fraction(scene) * scene.camera.exposure_time
