"""The clock of a film, from the phases and the times of its frames and from what is known.

The stripes of successive frames differ by m chips, up to whole periods of P chips. With a frame
period T, the frequency is (m + j P) / T with an unknown whole number j: neighbouring solutions are
P / T apart. What is known of the lamp or of the camera leaves one of them, or several.

Phases are fitted to the frames' numbers, as if frames came in equal steps, and to their stated
times; the fit with less scatter is used. A container that rounds times hides the true ones, but
leaves their mean step.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.results.clock import Clock, ClockSolution, MeasuredValue
from occ_model.scene.units import HERTZ, SECOND
from occ_model.video.clock import fit_clock, is_as_good
from occ_model.video.frame_times import FrameTimes, Part
from occ_model.video.known_timing import KnownTiming
from occ_model.video.phase_fit import ClockFit, FramePhases, mean_step

_MIN_FRAMES = 3  # minimum number of frames for a clock
_PHASE_ERRORS = 4.0  # standard errors of the phases by which the searched range is widened
_MIN_EXTENT = 1e-12  # ticks from the first frame to the last
_MAX_HIDDEN = 0.5  # periods within the times' resolution from which it hides the clock
_EQUAL_STEPS = 1e-9  # periods up to which times that deviate from equal steps are the same
_ROUNDED = 2.0  # steps of rounding up to which the scatter of times says nothing of the frames
_MAX_OUTLIER_FRACTION = 0.1  # fraction of the phases above which outliers are reported
_MAX_NAMED_SOLUTIONS = 5  # maximum number of alternative solutions in a sentence
_MIN_WANDER_RATIO = 3.0  # of all phases' scatter to that between frames, for a wandering clock


@dataclass(frozen=True, eq=False, slots=True)
class FilmFit:
    """A clock that fits the phases, in chips per tick: a frame, or a second as stated."""

    fit: ClockFit
    is_by_number: bool
    tick: float  # In seconds by the lamp or the camera, which slow motion divides
    values: ClockSolution

    @property
    def stated_frequency(self) -> float:
        """Chips in a second of the film's stated times."""
        return self.fit.frequency / (self.tick * self.values.slow_motion)

    @property
    def noise(self) -> float:
        """Standard deviation in seconds of a frame's time from its phase."""
        return self.fit.noise / self.fit.frequency * self.tick


@dataclass(frozen=True, eq=False, slots=True)
class FilmClock:
    """All clocks that fit a film, the likeliest first, or the reason why there is none."""

    fits: tuple[FilmFit, ...] = ()
    reason: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class FilmPhases:
    """The phases of a film's frames, the frames' numbers and times, and what is known."""

    phases: FramePhases
    numbers: IndexArray  # Shape (frames,): of the phases' frames, as in ``times``
    times: FrameTimes
    known: KnownTiming
    columns: int

    def fit_clocks(self) -> FilmClock:
        """Fit all clocks that agree with what is known."""
        if len(self.phases.times) < _MIN_FRAMES:
            return FilmClock(reason="fewer than three frames show the phase of the stripes.")
        found = by_number = self._fit(is_by_number=True)
        unequal = max(_EQUAL_STEPS * self.times.period.value, _ROUNDED * self.times.resolution)
        if self.times.scatter > unequal:
            by_time = self._fit(is_by_number=False)
            if by_time and (not by_number or by_time[0].noise < by_number[0].noise):
                found = by_time
        if not found:
            return FilmClock(reason=self._explain())
        best = min((each.fit for each in found), key=lambda fit: fit.chi_squared)
        found = [each for each in found if is_as_good(each.fit, best)]
        return FilmClock(tuple(sorted(found, key=self._unlikelihood)))

    def ticks(self, is_by_number: bool) -> FloatArray:
        """Return when the frames begin, in frames or in seconds as stated."""
        return self.numbers.astype(np.float64) if is_by_number else self.phases.times

    def _fit(self, is_by_number: bool) -> list[FilmFit]:
        """Fit clocks to numbers or times, for each slow motion that the film may have."""
        found: list[FilmFit] = []
        ticks = self.ticks(is_by_number)
        ticked = replace(self.phases, times=ticks)
        step, _ = mean_step(self.phases)
        extent = max(float(np.ptp(ticks)), _MIN_EXTENT)
        slack = _PHASE_ERRORS * float(np.median(self.phases.errors)) / extent
        for slow_motion in self.known.slow_motions:
            stated = self.times.period
            period = MeasuredValue(stated.value / slow_motion, stated.error / slow_motion)
            low, high = self.known.frequency_range(step, period, self.columns)
            if low >= high:
                break  # a shorter frame period leaves no time for the readout
            tick = period.value if is_by_number else 1.0 / slow_motion
            for fit in fit_clock(ticked, low * tick - slack, high * tick + slack):
                values = self._solve(fit, tick, period, is_by_number)
                found.append(FilmFit(fit, is_by_number, tick, values))
        return found

    def _solve(
        self, fit: ClockFit, tick: float, period: MeasuredValue, is_by_number: bool
    ) -> ClockSolution:
        """Return the values of a clock, with the errors of phases, times and what is known."""
        by_phase = fit.frequency_error / abs(fit.frequency)
        period_error = period.error / period.value
        by_film = fit.frequency / tick
        film_error = math.hypot(by_phase, period_error) if is_by_number else by_phase
        frequency, error = self.known.join(by_film, film_error)
        readout, by_step = fit.step / frequency, fit.step_error / fit.step
        frame_period = period.value * by_film / frequency
        read = self.columns * readout
        gap = frame_period - read
        if self.known.frequency_tolerance is not None:
            # The frame period is that of the phases by the lamp's clock, which the gap shares.
            of_period = math.hypot(error, by_phase, 0.0 if is_by_number else period_error)
            gap_error = math.hypot(gap * error, frame_period * by_phase, read * by_step)
        else:
            of_period = period_error
            gap_error = math.hypot(gap * period_error, read * math.hypot(by_step, by_phase))
        if not is_by_number:  # the mean of uneven steps has an error of its own
            gap_error = math.hypot(gap_error, frame_period * period_error)
        return ClockSolution(
            MeasuredValue(frequency, error * frequency),
            MeasuredValue(readout, readout * math.hypot(by_step, error)),
            MeasuredValue(frame_period, frame_period * of_period),
            MeasuredValue(gap, gap_error),
            slow_motion=round(self.times.period.value / period.value),
        )

    def _unlikelihood(self, found: FilmFit) -> tuple[int, int, bool, float]:
        values = found.values
        return (
            len(found.fit.jumps),
            int((~found.fit.kept).sum()) // 2,
            values.slow_motion > 1,
            self.known.unlikelihood(values.switching_frequency.value, values.readout_time.value),
        )

    def _explain(self) -> str:
        """Explain why no clock fits."""
        step, _ = mean_step(self.phases)
        low, high = self.known.frequency_range(step, self.times.period, self.columns)
        if low >= high:
            return (
                f"{self.columns} columns cannot be read out within a frame period of "
                f"{SECOND.format(self.times.period.value)} at any frequency that may be."
            )
        repeats = low * self.times.resolution / self.phases.period
        if repeats > _MAX_HIDDEN and self.times.scatter > self.times.resolution:
            return (
                "the frames do not come in equal steps, and their times are kept to "
                f"{SECOND.format(self.times.resolution)} only, in which what is sent repeats "
                f"{repeats:.2g} times."
            )
        return "no frequency that may be fits the phases of the frames, or too many do."


def describe_clock(clock: FilmClock, film: FilmPhases, part: Part, chips_of_cycle: int) -> Clock:
    """Return a film's clock for one part of its times.

    ``chips_of_cycle``: the number of chips in a lamp's cycle; 0 for a code.
    """
    best, times = clock.fits[0], film.times
    fit, values = best.fit, best.values
    frequency, noise = values.switching_frequency.value, best.noise
    drift = None
    if fit.drift_error > 0.0:
        scale = frequency / fit.frequency / best.tick
        drift = MeasuredValue(fit.drift * scale, fit.drift_error * scale)
    if not best.is_by_number:
        rounding = times.resolution / values.slow_motion
        noise = math.sqrt(max(noise**2 - rounding**2 / 12.0, 0.0))
    clock_part = [f"The clock is that of frames {part.first} to {part.end - 1}."]
    return Clock(
        values.switching_frequency,
        values.readout_time,
        values.frame_period,
        values.gap,
        values.slow_motion,
        drift=drift,
        timing_noise=noise,
        frames=int(fit.kept.sum()),
        spacing=film.phases.period / values.frame_period.value if best.is_by_number else None,
        chips_a_frame=MeasuredValue(fit.frequency, fit.frequency_error)
        if best.is_by_number
        else None,
        phase=_phase_at_zero(best, part),
        repeated_chips=film.phases.period,
        alternatives=tuple(other.values for other in clock.fits[1:]),
        problems=(
            *times.problems,
            *(clock_part if len(times.parts) > 1 else ()),
            *_describe_problems(clock, film.phases, chips_of_cycle or 1),
        ),
        chips_of_cycle=chips_of_cycle,
    )


def _phase_at_zero(best: FilmFit, part: Part) -> MeasuredValue:
    """Return the chips sent at the film's time 0 and their standard deviation."""
    fit = best.fit
    tick = -part.start * best.stated_frequency / fit.frequency if best.is_by_number else 0.0
    elapsed = tick - fit.middle
    error = math.hypot(
        fit.noise / math.sqrt(int(fit.kept.sum())),
        fit.frequency_error * elapsed,
        0.5 * fit.drift_error * elapsed**2,
    )
    return MeasuredValue(float(fit.at_start(np.array([tick]))[0]), error)


def clock_of_lamp(film: FilmPhases, reason: str, chips_of_cycle: int) -> Clock | None:
    """Return what a known frequency alone tells where no clock fits.

    None if it is not known, or if the columns would take longer than a frame period.
    """
    known, period = film.known, film.times.period
    step, step_error = mean_step(film.phases)
    low, high = known.frequency_range(step, period, film.columns)
    if known.frequency_tolerance is None or low >= high:
        return None
    relative = known.frequency_error
    readout = step / known.frequency
    readout_error = readout * math.hypot(step_error / step, relative)
    gap_error = math.hypot(period.error, film.columns * readout_error)
    return Clock(
        MeasuredValue(known.frequency, relative * known.frequency),
        MeasuredValue(readout, readout_error),
        period,
        MeasuredValue(period.value - film.columns * readout, gap_error),
        slow_motion=1,
        drift=None,
        timing_noise=None,
        frames=len(film.phases.times),
        problems=(
            *film.times.problems,
            "The readout time rests on the frequency of the lamp alone, which may be another one: "
            f"{reason}",
        ),
        chips_of_cycle=chips_of_cycle,
    )


def _describe_problems(clock: FilmClock, phases: FramePhases, chips: int) -> list[str]:
    """Describe what does not fit; ``chips``: the number that a stated frequency counts as one."""
    best, frequency = clock.fits[0].fit, clock.fits[0].values.switching_frequency.value
    problems = [
        f"At {SECOND.format(float(phases.times[jump.frame]))} the stripes jump by "
        f"{SECOND.format(jump.chips / frequency)} that the frame times do not show: frames "
        "were dropped, doubled or shifted there."
        for jump in best.jumps
    ]
    if len(clock.fits) > 1:
        problems.append(_describe_solutions(clock.fits, chips))
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
                f"{SECOND.format(scatter / frequency)}: the film was stabilised, its frame "
                "rate changes, or a clock wanders."
            )
    return problems


def _describe_solutions(fits: Sequence[FilmFit], chips: int) -> str:
    """List the clocks that fit equally well, of which the first one is stated."""
    texts = []
    for each in fits[: 1 + _MAX_NAMED_SOLUTIONS]:
        values = each.values
        slow = f", slow motion of 1/{values.slow_motion}" if values.slow_motion > 1 else ""
        frequency = HERTZ.format(values.switching_frequency.value / chips)
        texts.append(f"{frequency} ({SECOND.format(values.readout_time.value)} a column{slow})")
    more = len(fits) - len(texts)
    ending = f" and {more} more" if more else ""
    return (
        f"Several clocks fit the frames equally well: {texts[0]}, which is stated, and "
        f"{', '.join(texts[1:])}{ending}; the frequency of the lamp, a more accurate readout time "
        "or a longer packet would distinguish them."
    )
