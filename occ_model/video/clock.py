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
_TRIED_WITHOUT_CHANCE = 64.0  # number of frequencies too small for coherence by chance

_MIN_RELATIVE_COHERENCE = 0.8  # fraction of the best coherence from which an alias is fitted
_MIN_COHERENCE = 0.5  # minimum coherence of phases with the frame times
_PART_GROWTH = 1.3  # factor by which the fitted part of the film grows, once its frequency is known

_MAX_CHI_SQUARED_EXCESS = 9.0  # above this, three standard deviations, an alias is excluded

READOUT_TOLERANCE = 0.01  # maximum relative error of the given rough readout time
MOST_READOUT_TOLERANCE = 0.5
_MAX_READOUT_EXCESS = 1e-3  # fraction of the frame period by which the readout may exceed it
_MIN_FRAMES = 3  # minimum number of frames for a clock
_MAX_OUTLIER_FRACTION = 0.1  # fraction of the phases above which outliers are reported
_MAX_NAMED_FREQUENCIES = 5  # maximum number of alternative frequencies in a sentence

_MIN_WANDER_RATIO = 3.0  # of all phases' scatter to that between frames, for a wandering clock


def fit_clock(phases: FramePhases, low: float, high: float) -> tuple[ClockFit, ...]:
    """Return the frequencies from ``low`` to ``high`` in Hz that fit the phases, best first."""
    step, _ = mean_step(phases)
    reduced_phases = np.mod(phases.places - step * phases.columns, phases.period)
    all_fits = [
        _follow_phase(phases, reduced_phases, alias)
        for alias in _find_aliases(phases, reduced_phases, low, high)
    ]
    fits = _drop_repeated([fit for fit in all_fits if low <= fit.frequency <= high])
    if not fits:
        return ()
    best = fits[0]
    freedom = max(1, int(best.kept.sum()) - 3)
    # The scatter includes the jitter of the frame times, which the best fit shows.
    scale = max(1.0, best.chi_squared / freedom)
    return tuple(
        fit for fit in fits
        if fit.chi_squared - best.chi_squared <= _MAX_CHI_SQUARED_EXCESS * scale
        and len(fit.jumps) <= len(best.jumps)
    )  # fmt: skip


def _drop_repeated(fits: list[ClockFit]) -> list[ClockFit]:
    """Sort fits by the numbers of jumps and outliers, and drop repeated frequencies."""
    sorted_fits = sorted(
        fits, key=lambda fit: (len(fit.jumps), int((~fit.kept).sum()) // 2, fit.chi_squared)
    )
    distinct_fits: list[ClockFit] = []
    for fit in sorted_fits:
        min_distance = 3.0 * fit.frequency_error
        if all(abs(fit.frequency - other.frequency) > min_distance for other in distinct_fits):
            distinct_fits.append(fit)
    return distinct_fits


def _find_aliases(
    phases: FramePhases, reduced_phases: FloatArray, low: float, high: float
) -> list[float]:
    """Return the frequencies at which the phases of the first frames are coherent."""
    count = min(len(reduced_phases), _FIRST_FRAMES)
    while count > 2 and _grid_size(phases.times[:count], low, high, phases.period) > _MAX_TRIED:
        count = max(2, count // 2)
    times = phases.times[:count] - phases.times[0]
    tried_count = _grid_size(times, low, high, phases.period)
    # The mean of ``count`` random phasors is longer than r with probability exp(-count r^2).
    chance_coherence = math.sqrt(
        2.0 * math.log(max(tried_count / _TRIED_WITHOUT_CHANCE, 1.0)) / count
    )
    if tried_count > _MAX_TRIED or chance_coherence >= 1.0:
        return []
    frequencies = np.linspace(low, high, tried_count)
    coherences = _coherence(reduced_phases[:count], times, frequencies, phases.period)
    best = float(coherences.max())
    if best < max(_MIN_COHERENCE, 1.2 / math.sqrt(count), chance_coherence) and count > 2:
        return []
    padded = np.concatenate([[-1.0], coherences, [-1.0]])
    peaks = (padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:])
    indices = np.flatnonzero(peaks & (coherences >= _MIN_RELATIVE_COHERENCE * best))
    return [float(frequencies[place]) for place in indices] if len(indices) <= _MAX_ALIASES else []


def _grid_size(times: FloatArray, low: float, high: float, period: float) -> int:
    return int((high - low) * float(np.ptp(times)) / period * _GRID_POINTS_PER_TURN) + 3


def _coherence(
    reduced_phases: FloatArray, times: FloatArray, frequencies: FloatArray, period: float
) -> FloatArray:
    """Return the magnitude of the mean phase factor at each frequency."""
    coherences = np.empty(len(frequencies))
    for start in range(0, len(frequencies), 4096):
        part = slice(start, start + 4096)
        angle = (reduced_phases - frequencies[part, None] * times) * (2.0 * np.pi / period)
        coherences[part] = np.abs(np.exp(1j * angle).mean(axis=1))
    return coherences


def _follow_phase(phases: FramePhases, reduced_phases: FloatArray, frequency: float) -> ClockFit:
    """Unwrap the phase over the whole film, starting from a frequency, and fit it."""
    count, total = min(len(reduced_phases), _FIRST_FRAMES), len(reduced_phases)
    times = phases.times - phases.times[0]
    angle = np.exp(
        2j * np.pi * (reduced_phases[:count] - frequency * times[:count]) / phases.period
    )
    start = float(np.angle(angle.mean())) / (2.0 * np.pi) * phases.period
    predicted = start + frequency * times
    while True:
        rounds = np.rint((predicted[:count] - reduced_phases[:count]) / phases.period)
        fit = fit_parabola(phases.first(count), reduced_phases[:count] + rounds * phases.period)
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

    ``chips_of_cycle``: the number of chips in a lamp's cycle; 0 for a code.
    """
    best = fits[0]
    readout = best.step / best.frequency
    relative = np.hypot(best.step_error / best.step, best.frequency_error / best.frequency)
    readout_error = readout * float(relative)
    gap = times.period.value - columns * readout
    has_drift = best.drift_error > 0.0
    clock_part = [f"The clock is that of frames {part.first} to {part.end - 1}."]
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
            *(clock_part if len(times.parts) > 1 else ()),
            *_describe_problems(fits, phases, chips_of_cycle or 1),
        ),
        chips_of_cycle=chips_of_cycle,
    )


def _describe_problems(fits: tuple[ClockFit, ...], phases: FramePhases, chips: int) -> list[str]:
    """Describe what does not fit; ``chips``: the number that a stated frequency counts as one."""
    best = fits[0]
    problems = [
        f"At {SECOND.format(jump.time)} the stripes jump by "
        f"{SECOND.format(jump.chips / best.frequency)} that the frame times do not show: frames "
        "were dropped, doubled or shifted there."
        for jump in best.jumps
    ]
    if len(fits) > 1:
        texts = [HERTZ.format(fit.frequency / chips) for fit in fits[: 1 + _MAX_NAMED_FREQUENCIES]]
        others = ", ".join(
            f"{frequency} ({SECOND.format(fit.step / fit.frequency)} a column)"
            for frequency, fit in zip(texts[1:], fits[1:], strict=False)
        ) + (
            f" and {len(fits) - 1 - _MAX_NAMED_FREQUENCIES} more"
            if len(fits) > 1 + _MAX_NAMED_FREQUENCIES
            else ""
        )
        problems.append(
            f"Several frequencies fit the frames equally well: {texts[0]}, which is stated, and "
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
        step_scatter = float(np.sqrt(np.mean(np.diff(residuals) ** 2) / 2.0))
        scatter = float(np.std(residuals))
        stated_error = float(np.median(phases.errors))
        if scatter > _MIN_WANDER_RATIO * max(step_scatter, stated_error):
            problems.append(
                "The stripes drift back and forth relative to the frame times by "
                f"{SECOND.format(scatter / best.frequency)}: the film was stabilised, its frame "
                "rate changes, or a clock wanders."
            )
    return problems
