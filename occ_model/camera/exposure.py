"""The rolling shutter: how long the LED is on during each column's exposure.

Column ``i`` is exposed over [t_0 + i t_r, t_0 + i t_r + t]. The time that the LED is on during it
is a difference of two values of the waveform's running integral. This takes the same work for any
ratio of exposure time to switching period, without sampling in time or a loop over chips.
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
    """Return where in the sent period, in chips, each column's exposure starts.

    Start and step are reduced to one period exactly, as fractions; the columns follow in floating
    point. The step is split into whole chips, a part of only 24 bits, whose product with any column
    number is exact, and a remainder below 1e-7 chips. The error thus stays about 2e-16 chips after
    a million columns, however long the period is. ``shift`` is added to all starts. The result is
    read-only.
    """
    wanted = scene.camera.columns if columns is None else columns
    # Fewer columns than the picture's are a common request, so that at least these are cached.
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
    """Return the phases, cached by everything on which they depend; the exposure time is not."""
    frequency = Fraction(switching_frequency)
    start = (Fraction(start_time) * frequency + shift) % period
    phases = _count_phases(start, _step(readout_time, switching_frequency, period), period, columns)
    phases.chip.flags.writeable = phases.fraction.flags.writeable = False
    return phases


@lru_cache(maxsize=8)
def _step(readout_time: float, frequency: float, period: int) -> Fraction:
    return Fraction(readout_time) * Fraction(frequency) % period


def cycle_phases(scene: Scene, frequency: float, delay: Fraction) -> FloatArray:
    """Return a signal's phase (0 to 1) at a delay in seconds after each column's start."""
    cycles = Fraction(frequency)
    start = (Fraction(scene.model.start_time) + delay) * cycles % 1
    step = Fraction(scene.camera.readout_time) * cycles % 1
    return _count_phases(start, step, 1, scene.camera.columns).fraction


def _count_phases(start: Fraction, step: Fraction, period: int, count: int) -> PhasesInPeriod:
    """Count up from ``start`` by ``step``, both within one period."""
    start_chip = int(start)
    steps = _count_steps(step, count)
    fraction = steps.fraction + (steps.remainder + float(start - start_chip))
    carry = np.floor(fraction)
    fraction -= carry
    # A fraction just below zero can round to a whole chip when the floor is subtracted.
    over = fraction >= 1.0
    fraction[over] = 0.0
    carry += over
    carry += start_chip
    chip = np.add(steps.chip, carry, out=carry)
    # Exact, since a quotient of whole numbers this small never rounds up to a whole number.
    chip -= period * np.floor(chip / period)
    return PhasesInPeriod(chip.astype(np.int64), fraction)


@dataclass(frozen=True, eq=False, slots=True)
class _ColumnSteps:
    """How much later than the first column each column starts."""

    # Shape (columns,): whole chips of the exact part of the products
    chip: FloatArray
    # Shape (columns,): fractions of a chip of that part, and the remainder
    fraction: FloatArray
    remainder: FloatArray


@lru_cache(maxsize=8)
def _count_steps(step: Fraction, count: int) -> _ColumnSteps:
    """Count up from 0 by ``step``; pictures that differ only in start time share the steps."""
    step_chip = int(step)
    within = step - step_chip
    coarse = float(np.float32(float(within)))
    column = np.arange(count, dtype=np.float64)
    position = column * coarse
    chip = np.floor(position)
    fraction = position - chip
    chip += column * step_chip
    made = _ColumnSteps(chip, fraction, column * float(within - Fraction(coarse)))
    for values in (made.chip, made.fraction, made.remainder):
        values.flags.writeable = False
    return made


def lit_fraction(scene: Scene) -> FloatArray:
    """Return the fraction of each column's exposure with the LED on, t_on / t; read-only."""
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
    """Return the fraction, cached by everything on which it depends; the pose is not."""
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
    """Clear the caches, so that the next exposure takes as long as the first."""
    for kept in (_count_steps, _step, _column_starts, _lit_fraction, _waveform):
        kept.cache_clear()


@lru_cache(maxsize=16)
def _waveform(chips: bytes) -> Waveform:
    return Waveform(np.frombuffer(chips, dtype=np.uint8))


def on_time(scene: Scene) -> FloatArray:
    """Return how long the LED is on during each column's exposure, t_on(i).

    Returns
    -------
    ndarray of float64, shape (columns,)
        Seconds, from 0 to the exposure time; t_off is the rest of the exposure time.
    """
    return lit_fraction(scene) * scene.camera.exposure_time
