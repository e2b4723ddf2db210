"""Fit the clock of a film: the switching frequency that explains the phases of its frames.

A frame shows the phase of the chips only up to whole periods of what is sent. Frequencies that
differ by a whole number of periods between frames therefore fit equally well (aliases). A rough
frequency, from the chips per column and a rough readout time, selects one of them. The phase is
then counted over longer and longer parts of the film, each of which predicts the next one.
"""

import math

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.video_reading import Clock, MeasuredValue
from occ_model.scene.units import HERTZ, SECOND
from occ_model.video.frame_times import FrameTimes, Part
from occ_model.video.phase_fit import ClockFit, FramePhases, fit_parabola, mean_step

_FIRST_FRAMES = 64  # number of frames at the start in which aliases are searched

_GRID_POINTS_PER_TURN = 8.0  # frequencies tried while the last phase turns by a period
_MAX_TRIED = 2**17  # maximum number of frequencies tried; the part of the film is shortened to it

_MAX_ALIASES = 64  # with more, for example of frames far apart, no frequency is stated
_TRIED_WITHOUT_CHANCE = 64.0  # number of frequencies of which none is coherent by chance

_MIN_RELATIVE_COHERENCE = 0.8  # fraction of the best coherence from which an alias is fitted
_MIN_COHERENCE = 0.5  # minimum coherence of phases with the frame times
_PART_GROWTH = 1.3  # factor by which the fitted part of the film grows, once its frequency is known

_MAX_CHI_SQUARED_EXCESS = 9.0  # above this, three standard deviations, an alias is excluded

READOUT_TOLERANCE = 0.01  # maximum relative error of the given rough readout time
MOST_READOUT_TOLERANCE = 0.5
_MAX_READOUT_EXCESS = 1e-3  # fraction of the frame period by which the readout may exceed it
_MIN_FRAMES = 3  # minimum number of frames for a clock
_MAX_OUTLIER_FRACTION = 0.1  # fraction of outliers among the phases from which they are reported
_MAX_NAMED_FREQUENCIES = 5  # maximum number of alternative frequencies in a sentence

_MIN_WANDER_RATIO = 3.0  # of the phases' scatter to that between frames, for wandering


def fit_clock(phases: FramePhases, low: float, high: float) -> tuple[ClockFit, ...]:
    """Return the frequencies from ``low`` to ``high`` in Hz that fit the phases, best first."""
    step, _ = mean_step(phases)
    turned = np.mod(phases.places - step * phases.columns, phases.period)
    followed = [
        _follow_phase(phases, turned, one) for one in _find_aliases(phases, turned, low, high)
    ]
    fits = _drop_repeated([fit for fit in followed if low <= fit.frequency <= high])
    if not fits:
        return ()
    best = fits[0]
    free = max(1, int(best.kept.sum()) - 3)
    # The scatter includes the jitter of the frame times, which the best fit shows.
    scale = max(1.0, best.chi_squared / free)
    return tuple(
        fit for fit in fits
        if fit.chi_squared - best.chi_squared <= _MAX_CHI_SQUARED_EXCESS * scale
        and len(fit.jumps) <= len(best.jumps)
    )  # fmt: skip


def _drop_repeated(fits: list[ClockFit]) -> list[ClockFit]:
    """Sort fits by the numbers of jumps and outliers, and drop repeated frequencies."""
    ordered = sorted(
        fits, key=lambda fit: (len(fit.jumps), int((~fit.kept).sum()) // 2, fit.chi_squared)
    )
    kept: list[ClockFit] = []
    for fit in ordered:
        apart = 3.0 * fit.frequency_error
        if all(abs(fit.frequency - other.frequency) > apart for other in kept):
            kept.append(fit)
    return kept


def _find_aliases(phases: FramePhases, turned: FloatArray, low: float, high: float) -> list[float]:
    """Return the frequencies at which the phases of the first frames are coherent."""
    count = min(len(turned), _FIRST_FRAMES)
    while count > 2 and _grid_size(phases.times[:count], low, high, phases.period) > _MAX_TRIED:
        count = max(2, count // 2)
    times = phases.times[:count] - phases.times[0]
    number = _grid_size(times, low, high, phases.period)
    # The mean of ``count`` random phasors is longer than r with probability exp(-count r^2).
    by_chance = math.sqrt(2.0 * math.log(max(number / _TRIED_WITHOUT_CHANCE, 1.0)) / count)
    if number > _MAX_TRIED or by_chance >= 1.0:
        return []
    tried = np.linspace(low, high, number)
    coherent = _coherence(turned[:count], times, tried, phases.period)
    best = float(coherent.max())
    if best < max(_MIN_COHERENCE, 1.2 / math.sqrt(count), by_chance) and count > 2:
        return []
    padded = np.concatenate([[-1.0], coherent, [-1.0]])
    peaks = (padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:])
    chosen = np.flatnonzero(peaks & (coherent >= _MIN_RELATIVE_COHERENCE * best))
    return [float(tried[place]) for place in chosen] if len(chosen) <= _MAX_ALIASES else []


def _grid_size(times: FloatArray, low: float, high: float, period: float) -> int:
    return int((high - low) * float(np.ptp(times)) / period * _GRID_POINTS_PER_TURN) + 3


def _coherence(
    turned: FloatArray, times: FloatArray, tried: FloatArray, period: float
) -> FloatArray:
    """Return the magnitude of the mean phase factor at each frequency."""
    coherent = np.empty(len(tried))
    for start in range(0, len(tried), 4096):
        part = slice(start, start + 4096)
        angle = (turned - tried[part, None] * times) * (2.0 * np.pi / period)
        coherent[part] = np.abs(np.exp(1j * angle).mean(axis=1))
    return coherent


def _follow_phase(phases: FramePhases, turned: FloatArray, frequency: float) -> ClockFit:
    """Unwrap the phase over the whole film, starting from a frequency, and fit it."""
    count, total = min(len(turned), _FIRST_FRAMES), len(turned)
    times = phases.times - phases.times[0]
    angle = np.exp(2j * np.pi * (turned[:count] - frequency * times[:count]) / phases.period)
    start = float(np.angle(angle.mean())) / (2.0 * np.pi) * phases.period
    predicted = start + frequency * times
    while True:
        rounds = np.rint((predicted[:count] - turned[:count]) / phases.period)
        fit = fit_parabola(phases.first(count), turned[:count] + rounds * phases.period)
        if count == total:
            return fit
        count = min(total, max(count + 1, int(count * _PART_GROWTH)))
        predicted = fit.at_start(phases.times)


def fit_film_clock(
    phases: FramePhases, readout_time: float, tolerance: float, columns: int, period: float
) -> tuple[ClockFit, ...]:
    """Fit the clock for a readout time within ``tolerance``; ``period``: of the frames, in s."""
    if len(phases.times) < _MIN_FRAMES:
        return ()
    step, _ = mean_step(phases)
    low = step / (readout_time * (1.0 + tolerance))
    high = step / (readout_time * (1.0 - tolerance))
    low = max(low, step * columns / (period * (1.0 + _MAX_READOUT_EXCESS)))
    return fit_clock(phases, low, high) if low < high else ()


def describe_clock(
    fits: tuple[ClockFit, ...],
    phases: FramePhases,
    times: FrameTimes,
    part: Part,
    columns: int,
    chips_of_cycle: int,
) -> Clock:
    """Return a film's clock for one part of its times, from fits sorted by likelihood.

    ``chips_of_cycle``: how many chips of the phases make a cycle of a lamp; 0 of a code.
    """
    best = fits[0]
    readout = best.step / best.frequency
    relative = np.hypot(best.step_error / best.step, best.frequency_error / best.frequency)
    readout_error = readout * float(relative)
    gap = times.period.value - columns * readout
    has_drift = best.drift_error > 0.0
    only = [f"The clock is that of frames {part.first} to {part.end - 1}."]
    return Clock(
        switching_frequency=MeasuredValue(best.frequency, best.frequency_error),
        drift=MeasuredValue(best.drift, best.drift_error) if has_drift else None,
        readout_time=MeasuredValue(readout, readout_error),
        frame_period=times.period,
        gap=MeasuredValue(gap, float(np.hypot(times.period.error, columns * readout_error))),
        timing_noise=best.noise / best.frequency,
        frames=int(best.kept.sum()),
        alternatives=tuple((fit.frequency, fit.step / fit.frequency) for fit in fits[1:]),
        problems=(
            *times.problems,
            *(only if len(times.parts) > 1 else ()),
            *_describe_problems(fits, phases, chips_of_cycle or 1),
        ),
        chips_of_cycle=chips_of_cycle,
    )


def _describe_problems(fits: tuple[ClockFit, ...], phases: FramePhases, chips: int) -> list[str]:
    """Say what does not fit; ``chips``: how many a stated frequency counts as one."""
    best = fits[0]
    problems = [
        f"At {SECOND.format(jump.time)} the stripes jump by "
        f"{SECOND.format(jump.chips / best.frequency)} that the frame times do not show: frames "
        "were dropped, doubled or shifted there."
        for jump in best.jumps
    ]
    if len(fits) > 1:
        named = [HERTZ.format(fit.frequency / chips) for fit in fits[: 1 + _MAX_NAMED_FREQUENCIES]]
        others = ", ".join(
            f"{frequency} ({SECOND.format(fit.step / fit.frequency)} a column)"
            for frequency, fit in zip(named[1:], fits[1:], strict=False)
        ) + (
            f" and {len(fits) - 1 - _MAX_NAMED_FREQUENCIES} more"
            if len(fits) > 1 + _MAX_NAMED_FREQUENCIES
            else ""
        )
        problems.append(
            f"Several frequencies fit the frames equally well: {named[0]}, which is stated, and "
            f"{others}; a more accurate readout time or a longer packet would distinguish them."
        )
    outliers = int((~best.kept).sum())
    if outliers > _MAX_OUTLIER_FRACTION * len(best.kept):
        problems.append(
            f"{outliers} of {len(best.kept)} frames show a phase that does not agree with that of "
            "the others."
        )
    residuals = best.residuals[best.kept]
    if len(residuals) >= 16:
        steps = float(np.sqrt(np.mean(np.diff(residuals) ** 2) / 2.0))
        scatter = float(np.std(residuals))
        least = float(np.median(phases.errors))
        if scatter > _MIN_WANDER_RATIO * max(steps, least):
            problems.append(
                "The stripes drift back and forth relative to the frame times by "
                f"{SECOND.format(scatter / best.frequency)}: the film was stabilised, its frame "
                "rate changes, or a clock wanders."
            )
    return problems
