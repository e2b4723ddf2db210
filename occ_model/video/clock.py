"""Fit a clock to phases: the frequency that explains the phases at given times.

A frame shows the phase of the chips only up to whole periods of what is sent. Frequencies that
differ by a whole number of periods between frames therefore fit equally well (aliases). A rough
frequency, from the chips per column and a rough readout time, selects one of them. The phase is
then counted over longer and longer parts of the film, each of which predicts the next one.
"""

import math

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.video.phase_fit import ClockFit, FramePhases, fit_parabola, mean_step

_FIRST_FRAMES = 64  # number of frames at the start in which aliases are searched

_GRID_POINTS_PER_TURN = 8.0  # frequencies tried while the last phase turns by a period
_MAX_TRIED = 2**17  # maximum number of frequencies tried; the part of the film is shortened to it

_MAX_ALIASES = 64  # with more, for example of frames far apart, no frequency is stated
_TRIED_WITHOUT_CHANCE = 64.0  # number of frequencies too small for coherence by chance

_MIN_RELATIVE_COHERENCE = 0.8  # fraction of the best coherence from which an alias is fitted
_MIN_COHERENCE = 0.5  # minimum coherence of phases with the frame times
# Scatter of phases, in periods, from which whole periods are miscounted, or a few agree by chance
_MAX_NOISE, _MAX_NOISE_OF_SHORT = 1 / 8, 1 / 12
_SHORT_FILM = 20  # frames
_PART_GROWTH = 1.3  # factor by which the fitted part of the film grows, once its frequency is known

_MAX_CHI_SQUARED_EXCESS = 9.0  # above this, three standard deviations, an alias is excluded


def fit_clock(phases: FramePhases, low: float, high: float) -> tuple[ClockFit, ...]:
    """Return the frequencies from ``low`` to ``high`` that fit the phases, best first."""
    step, _ = mean_step(phases)
    reduced_phases = np.mod(phases.places - step * phases.columns, phases.period)
    all_fits = [
        _follow_phase(phases, reduced_phases, alias)
        for alias in _find_aliases(phases, reduced_phases, low, high)
    ]
    is_short = len(phases.times) < _SHORT_FILM
    max_noise = (_MAX_NOISE_OF_SHORT if is_short else _MAX_NOISE) * phases.period
    fits = _drop_repeated(
        [fit for fit in all_fits if low <= fit.frequency <= high and fit.noise <= max_noise]
    )
    if not fits:
        return ()
    return tuple(fit for fit in fits if is_as_good(fit, fits[0]))


def is_as_good(fit: ClockFit, best: ClockFit) -> bool:
    """Return whether a fit is nearly as good as another one."""
    freedom = max(1, int(best.kept.sum()) - 3)
    # The scatter includes the jitter of the frame times, which the best fit shows.
    scale = max(1.0, best.chi_squared / freedom)
    # Errors of the times turn the phase in proportion to the frequency, and favour low ones.
    chi_squared = fit.chi_squared * min(1.0, (best.frequency / fit.frequency) ** 2)
    is_close = chi_squared - best.chi_squared <= _MAX_CHI_SQUARED_EXCESS * scale
    return is_close and len(fit.jumps) <= len(best.jumps)


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
