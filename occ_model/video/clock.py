"""State the clock of a film: frequency, readout time and gap, and what contradicts them."""

import numpy as np

from occ_model.results.video_reading import Clock, Measured
from occ_model.scene.units import HERTZ, SECOND
from occ_model.video.clock_fit import fit_clock
from occ_model.video.frame_times import FrameTimes, Part
from occ_model.video.phases import ClockFit, Phases, mean_step

READOUT_TOLERANCE = 0.01  # maximum relative difference of the readout time from the given rough one
_MAX_READOUT_EXCESS = 1e-3  # relative error by which the readout may exceed the frame period
_MIN_FRAMES = 3  # minimum number of frames to fit the clock to
_MAX_OUTLIER_FRACTION = 0.1  # outlier fraction of the phases that triggers a warning
_MAX_NAMED_FREQUENCIES = 5  # maximum number of other frequencies that a sentence names

_MIN_WANDER_RATIO = 3.0  # of the phases' scatter to that between frames from which they wander


def fits_of(
    phases: Phases, readout_time: float, tolerance: float, columns: int, period: float
) -> tuple[ClockFit, ...]:
    """Fit the clock to phases, by a rough readout time in seconds that is wrong by a fraction.

    ``period``: the frame period in seconds: reading out a frame takes no longer.
    """
    if len(phases.times) < _MIN_FRAMES:
        return ()
    step, _ = mean_step(phases)
    low = step / (readout_time * (1.0 + tolerance))
    high = step / (readout_time * (1.0 - tolerance))
    low = max(low, step * columns / (period * (1.0 + _MAX_READOUT_EXCESS)))
    return fit_clock(phases, low, high) if low < high else ()


def state(
    fits: tuple[ClockFit, ...], phases: Phases, times: FrameTimes, part: Part, columns: int
) -> Clock:
    """State what fits, the likeliest first, say of a film's clock in one part of its times."""
    best = fits[0]
    readout = best.step / best.frequency
    relative = np.hypot(best.step_error / best.step, best.frequency_error / best.frequency)
    readout_error = readout * float(relative)
    gap = times.period.value - columns * readout
    has_drift = best.drift_error > 0.0
    only = [f"The clock is that of frames {part.first} to {part.end - 1}."]
    return Clock(
        switching_frequency=Measured(best.frequency, best.frequency_error),
        drift=Measured(best.drift, best.drift_error) if has_drift else None,
        readout_time=Measured(readout, readout_error),
        frame_period=times.period,
        gap=Measured(gap, float(np.hypot(times.period.error, columns * readout_error))),
        timing_noise=best.noise / best.frequency,
        frames=int(best.kept.sum()),
        alternatives=tuple((fit.frequency, fit.step / fit.frequency) for fit in fits[1:]),
        problems=(
            *times.problems,
            *(only if len(times.parts) > 1 else ()),
            *_problems(fits, phases),
        ),
    )


def _problems(fits: tuple[ClockFit, ...], phases: Phases) -> list[str]:
    best = fits[0]
    problems = [
        f"Between the frames before {SECOND.format(jump.time)} and after it, the stripes move by "
        f"{SECOND.format(jump.chips / best.frequency)} that the frame times do not show: frames "
        "were dropped, doubled or shifted there."
        for jump in best.jumps
    ]
    if len(fits) > 1:
        others = ", ".join(
            f"{HERTZ.format(fit.frequency)} ({SECOND.format(fit.step / fit.frequency)} a column)"
            for fit in fits[1 : 1 + _MAX_NAMED_FREQUENCIES]
        ) + (
            f" and {len(fits) - 1 - _MAX_NAMED_FREQUENCIES} more"
            if len(fits) > 1 + _MAX_NAMED_FREQUENCIES
            else ""
        )
        problems.append(
            f"Several frequencies fit the frames alike: {HERTZ.format(best.frequency)} is stated, "
            f"but also {others}; a more accurate readout time, or a longer packet, would "
            "distinguish them."
        )
    outliers = int((~best.kept).sum())
    if outliers > _MAX_OUTLIER_FRACTION * len(best.kept):
        problems.append(
            f"{outliers} of {len(best.kept)} frames show a phase that does not agree with the "
            "others' times."
        )
    residuals = best.residuals[best.kept]
    if len(residuals) >= 16:
        steps = float(np.sqrt(np.mean(np.diff(residuals) ** 2) / 2.0))
        scatter = float(np.std(residuals))
        least = float(np.median(phases.errors))
        if scatter > _MIN_WANDER_RATIO * max(steps, least):
            problems.append(
                "The stripes drift to and fro against the frame times by "
                f"{SECOND.format(scatter / best.frequency)}: the film was stabilised, its frame "
                "rate changes, or a clock wanders."
            )
    return problems
