"""The rolling shutter: how long each column sees the panel lit.

Column ``i`` is exposed over [t_0 + i t_r, t_0 + i t_r + t]. The time that the LED is on within it
is a difference of two values of the waveform's running integral: the same work for any ratio of
exposure time to switching period, with no sampling in time and no loop over chips.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips
from occ_model.transmitter.waveform import Duration, PhasesInPeriod, Waveform

_NO_SHIFT = Fraction(0)


def column_phases(
    scene: Scene, period: int, shift: Fraction = _NO_SHIFT, columns: int | None = None
) -> PhasesInPeriod:
    """Return the place in the sent period, in chips, where each column's exposure starts.

    Start and step are reduced to one period in exact arithmetic, as fractions; the columns follow
    in floating point. The step is split in whole chips, a part short enough (24 bits) that its
    product with any column number is exact, and a remainder below 1e-7 chips: the error stays about
    2e-16 chips after a million columns, however many chips a period has. ``shift`` is added to all
    starts. The result is read-only.
    """
    wanted = scene.camera.columns if columns is None else columns
    # Parts of a picture are read more often than more than a picture: all have its columns.
    known = _column_starts(
        scene.transmitter.switching_frequency,
        scene.camera.readout_time,
        scene.model.start_time,
        period,
        shift,
        max(wanted, scene.camera.columns),
    )
    return known if wanted == len(known.chip) else known.first(wanted)


@lru_cache(maxsize=8)
def _column_starts(
    switching_frequency: float,
    readout_time: float,
    start_time: float,
    period: int,
    shift: Fraction,
    columns: int,
) -> PhasesInPeriod:
    """Return the phases, cached by all that they depend on; not the exposure time."""
    frequency = Fraction(switching_frequency)
    start = (Fraction(start_time) * frequency + shift) % period
    phases = _phases(start, _step(readout_time, switching_frequency, period), period, columns)
    phases.chip.flags.writeable = phases.fraction.flags.writeable = False
    return phases


@lru_cache(maxsize=8)
def _step(readout_time: float, frequency: float, period: int) -> Fraction:
    return Fraction(readout_time) * Fraction(frequency) % period


def cycle_phases(scene: Scene, frequency: float, delay: Fraction) -> FloatArray:
    """Return the phase (0 to 1) of a signal at a delay in seconds after each column's start."""
    cycles = Fraction(frequency)
    start = (Fraction(scene.model.start_time) + delay) * cycles % 1
    step = Fraction(scene.camera.readout_time) * cycles % 1
    return _phases(start, step, 1, scene.camera.columns).fraction


def _phases(start: Fraction, step: Fraction, period: int, count: int) -> PhasesInPeriod:
    """Count up from ``start`` by ``step``, both within one period."""
    start_chip = int(start)
    steps = _steps(step, count)
    fraction = steps.fraction + (steps.remainder + float(start - start_chip))
    carry = np.floor(fraction)
    fraction -= carry
    # A fraction just below zero rounds up to a whole chip when that chip is taken away from it.
    over = fraction >= 1.0
    fraction[over] = 0.0
    carry += over
    carry += start_chip
    chip = np.add(steps.chip, carry, out=carry)
    # Exact: a quotient of whole numbers this small never rounds up to a whole number.
    chip -= period * np.floor(chip / period)
    return PhasesInPeriod(chip.astype(np.int64), fraction)


@dataclass(frozen=True, eq=False, slots=True)
class _Steps:
    """How far each column starts after the first one."""

    # Shape (columns,): whole chips, of the part of the step whose products are exact
    chip: FloatArray
    # Shape (columns,): fraction of a chip of that part, and the rest of the step
    fraction: FloatArray
    remainder: FloatArray


@lru_cache(maxsize=8)
def _steps(step: Fraction, count: int) -> _Steps:
    """Count up from 0 by ``step``; pictures that differ in their start time use the same steps."""
    step_chip = int(step)
    within = step - step_chip
    coarse = float(np.float32(float(within)))
    column = np.arange(count, dtype=np.float64)
    position = column * coarse
    chip = np.floor(position)
    fraction = position - chip
    chip += column * step_chip
    made = _Steps(chip, fraction, column * float(within - Fraction(coarse)))
    for values in (made.chip, made.fraction, made.remainder):
        values.flags.writeable = False
    return made


def lit_fraction(scene: Scene) -> FloatArray:
    """Return the fraction of each column's exposure in which the LED is on, t_on / t; read-only."""
    transmitter, camera = scene.transmitter, scene.camera
    return _lit_fraction(
        sent_chips(transmitter).tobytes(),
        transmitter.switching_frequency,
        camera.exposure_time,
        camera.readout_time,
        camera.columns,
        scene.model.start_time,
    )


@lru_cache(maxsize=8)
def _lit_fraction(
    chips: bytes,
    switching_frequency: float,
    exposure_time: float,
    readout_time: float,
    columns: int,
    start_time: float,
) -> FloatArray:
    """Return the fraction, cached by all that it depends on; not the pose."""
    waveform = _waveform(chips)
    frequency = Fraction(switching_frequency)
    exposure = Duration.of(Fraction(exposure_time) * frequency, waveform.period)
    starts = _column_starts(
        switching_frequency, readout_time, start_time, waveform.period, _NO_SHIFT, columns
    )
    lit = waveform.lit_chips(starts, exposure)
    lit /= exposure.in_chips(waveform.period)
    np.clip(lit, 0.0, 1.0, out=lit)
    lit.flags.writeable = False
    return lit


def forget_exposures() -> None:
    """Clear the caches: the next exposure takes the time of a first one."""
    for kept in (_steps, _step, _column_starts, _lit_fraction, _waveform):
        kept.cache_clear()


@lru_cache(maxsize=16)
def _waveform(chips: bytes) -> Waveform:
    return Waveform(np.frombuffer(chips, dtype=np.uint8))


def on_time(scene: Scene) -> FloatArray:
    """Return the time that the LED is on while each column is exposed, t_on(i).

    Returns
    -------
    ndarray of float64, shape (columns,)
        Seconds, from 0 to the exposure time; t_off is the exposure time less this.
    """
    return lit_fraction(scene) * scene.camera.exposure_time
