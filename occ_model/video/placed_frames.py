"""The frames of a film, each at its place in what is sent, and the clock that predicts places.

Headers place the first frames; their phases give the clock; the clock and the chips that are known
by then place others, whose phases improve the clock.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.results.video_reading import Clock, FrameReading
from occ_model.video.clock import fits_of, state
from occ_model.video.frame_times import FrameTimes, Part, frame_times
from occ_model.video.joining import Joined
from occ_model.video.packets import CountedPart, PlacedFrame, counted_on
from occ_model.video.period import SentPeriod
from occ_model.video.phase_fit import ClockFit, Phases
from occ_model.video.read_frame import TimedFrame

_REFIT_GROWTH = 1.25  # factor of the number of frames after which the clock is fitted anew
FIRST_FIT = 3  # placed frames from which the clock is fitted
_MIN_PREDICTING_FRAMES = 6  # minimum frames of a fit that predicts the places of others
_ROUNDS = 4  # maximum rounds over unplaced frames at the end

PART_UNKNOWN = "No frame shows which sub-packet it shows, and no sub-packet was in view as a whole."


class PlacedFrames:
    """Frames, in the order of time, and their places, by a readout time known to a fraction."""

    def __init__(self, period: SentPeriod, readout_time: float, tolerance: float) -> None:
        self.joined = Joined(period)
        self.clock: Clock | None = None
        self.time_step = 0.0
        self.columns = 0
        self.frames: list[TimedFrame] = []
        self.placed = 0
        self.part_unknown = False  # whether places are right but for a whole number of sub-packets
        self._period = period
        self._readout_time, self._tolerance = readout_time, tolerance
        self._places: list[int | None] = []
        self._fits: tuple[ClockFit, ...] = ()
        self._next_fit, self._next_try = FIRST_FIT, _MIN_PREDICTING_FRAMES
        self._times: FrameTimes | None = None
        self._clock_from = 0

    def add(self, timed: TimedFrame) -> bool:
        """Add the next frame; return whether the clock was fitted anew."""
        self.frames.append(timed)
        self._places.append(None)
        self._place(len(self.frames) - 1)
        if self.placed == 0 and len(self.frames) >= self._next_try:
            self._next_try = _later(len(self.frames))
            self._place_within_parts()
        if self.placed < self._next_fit:
            return False
        self._next_fit = _later(self.placed)
        self._fit()
        self._place_others()
        return True

    def settle(self) -> None:
        """Place whatever can be placed with all frames at hand."""
        if self.placed == 0:
            self._place_within_parts()
        for _ in range(_ROUNDS):
            self._fit()
            if not self._place_others():
                break

    @property
    def fit(self) -> ClockFit | None:
        return self._fits[0] if self._fits else None

    def reading(self, number: int) -> FrameReading:
        reading, place = self.frames[number].reading, self._places[number]
        if place is None:
            unknown = "The frame shows no header, and its place in the packet is not known."
            return replace(reading, failure=reading.failure or unknown)
        if self.part_unknown:
            return replace(reading, failure=PART_UNKNOWN)
        return replace(reading, place=place)

    def times(self) -> FrameTimes | None:
        """Return the frames' times; None for fewer than two."""
        times = np.array([timed.reading.time for timed in self.frames])
        return frame_times(times, self.time_step) if len(times) > 1 else None

    def counted(self) -> list[CountedPart]:
        """Return the parts of the film on the count of all chips sent; needs a fit."""
        times, fit = self.times(), self.fit
        assert times is not None  # noqa: S101 - there is a fit of them
        assert fit is not None  # noqa: S101 - the caller has asked
        return [self._counted_part(fit, part) for part in times.parts]

    def _counted_part(self, fit: ClockFit, part: Part) -> CountedPart:
        """Count the chips of a part by the clock: from its own frames, if it is not the clock's."""
        length = self._period.length
        both = [
            (self.frames[number], place)
            for number in range(part.first, part.end)
            if (place := self._places[number]) is not None
        ]
        begins, inside, places = _shown(fit, both)
        if part.first <= self._clock_from < part.end:
            starts = fit.at_start(begins)
            start, end = fit.at_start(np.array([part.start, part.start + part.duration])).tolist()
        else:
            starts = fit.frequency * (begins - part.start)
            turns = np.exp(2j * np.pi * (places - starts - inside) / length).sum()
            start = float(np.angle(turns)) / (2.0 * np.pi) * length
            starts, end = starts + start, start + fit.frequency * part.duration
        firsts = counted_on(places, starts + inside, length).tolist()
        frames = [
            PlacedFrame(timed.reading, first)
            for (timed, _), first in zip(both, firsts, strict=True)
        ]
        return CountedPart(frames, part.start, part.duration, (start, end))

    def _place(self, number: int) -> bool:
        timed = self.frames[number]
        if not timed.is_read:
            return False
        foretold, deviation, fit = None, 0.0, self.fit
        if (
            fit is not None
            and fit.kept.sum() >= _MIN_PREDICTING_FRAMES
            and self._is_foretold(number)
        ):
            time = timed.reading.time
            phase = float(fit.at_start(np.array([time]))[0]) + fit.step * timed.column
            foretold = (phase - timed.middle) % self._period.length
            deviation = float(np.hypot(fit.phase_error(time), timed.middle_error))
        place = self.joined.place(timed.reading, foretold, deviation, self.part_unknown)
        if place is None:
            return False
        self._enter(number, place)
        return True

    def _is_foretold(self, number: int) -> bool:
        """Whether the times from the frames that the clock was fitted to lead on to a frame."""
        times = self._times
        if times is None:
            return False
        known = min(number, len(times.numbers) - 1)
        if times.part_of(known).first != self._clock_from:
            return False
        since = [timed.reading.time for timed in self.frames[known : number + 1]]
        return not any(times.is_jump(after - before) for before, after in pairwise(since))

    def _enter(self, number: int, place: int) -> None:
        self._places[number] = place
        self.placed += 1
        self.joined.add(self.frames[number].reading, place)
        if self.part_unknown:
            self._find_part()

    def _place_others(self) -> bool:
        others = [number for number, place in enumerate(self._places) if place is None]
        return sum(self._place(number) for number in others) > 0

    def _place_within_parts(self) -> None:
        """Place frames that show where a sub-packet starts, but none of which shows which it is.

        Their phases within a sub-packet give the clock, and that how many sub-packets lie between
        them. Which one the first of them is shows once all chips of any are known.
        """
        length = self._period.part_length
        if self._period.parts == 1:
            return
        shown = []
        for number, timed in enumerate(self.frames):
            first, last = timed.reading.whole
            places = self._period.places(timed.reading.chips[first:last])
            if places:
                shown.append((number, (places[0] - first) % length))
        times = self.times()
        if times is None or not times.follow:
            return
        part = _fullest(times, (number for number, _ in shown))
        shown = [(number, place) for number, place in shown if part.first <= number < part.end]
        both = [(self.frames[number], place) for number, place in shown]
        if len(both) < _MIN_PREDICTING_FRAMES:
            return
        phases = _phases(both, length)
        fits = fits_of(
            phases, self._readout_time, self._tolerance, self.columns, times.period.value
        )
        if len(fits) != 1:
            return
        self.part_unknown = True
        begins, inside, within = _shown(fits[0], both)
        firsts = counted_on(within, fits[0].at_start(begins) + inside, length).tolist()
        for (number, _), first, kept in zip(shown, firsts, fits[0].kept, strict=True):
            if kept:
                self._enter(number, first % self._period.length)

    def _find_part(self) -> None:
        """Find which sub-packet is which, once all chips of one are known."""
        length, known = self._period.part_length, self.joined.known
        chips = (self.joined.ratios > 0.0).astype(np.uint8)
        for part in np.flatnonzero(known.reshape(-1, length).all(axis=1)).tolist():
            found = self._period.part_bits(chips[part * length : (part + 1) * length])
            if found is not None:
                self.part_unknown = False
                shift = (found[0] - part) * length
                self.joined.rotate(shift)
                self._places = [
                    None if place is None else (place + shift) % self._period.length
                    for place in self._places
                ]
                self._fit()
                return

    def _fit(self) -> None:
        self._fits, self.clock, times = (), None, self.times()
        if times is None or not times.follow:
            return
        placed = [(n, place) for n, place in enumerate(self._places) if place is not None]
        part = _fullest(times, (number for number, _ in placed))
        both = [(self.frames[n], chip) for n, chip in placed if part.first <= n < part.end]
        if len(both) < FIRST_FIT:
            return
        phases, period = _phases(both, self._period.length), times.period.value
        self._times, self._clock_from = times, part.first
        self._fits = fits_of(phases, self._readout_time, self._tolerance, self.columns, period)
        if self._fits:
            self.clock = state(self._fits, phases, times, part, self.columns)


def _fullest(times: FrameTimes, frames: Iterable[int]) -> Part:
    counts = np.zeros(len(times.parts), dtype=np.int64)
    ends = np.array([part.end for part in times.parts])
    np.add.at(counts, np.searchsorted(ends, np.array(list(frames), np.int64), side="right"), 1)
    return times.parts[int(counts.argmax())]


def _later(count: int) -> int:
    return int(np.ceil(count * _REFIT_GROWTH)) + 1


def _shown(
    fit: ClockFit, both: Sequence[tuple[TimedFrame, int]]
) -> tuple[FloatArray, FloatArray, IndexArray]:
    """Return when frames begin, the chips from there to their first one, and its place."""
    return (
        np.array([timed.reading.time for timed, _ in both]),
        np.array([fit.step * timed.column - timed.middle for timed, _ in both]),
        np.array([place for _, place in both], dtype=np.int64),
    )


def _phases(both: Sequence[tuple[TimedFrame, int]], period: int) -> Phases:
    """Return the phases of frames whose first chip's place is known within a period."""
    rows = [
        (
            timed.reading.time,
            timed.column,
            (place + timed.middle) % period,
            timed.middle_error,
            timed.step,
            timed.step_error,
        )
        for timed, place in both
    ]
    times, columns, places, errors, steps, step_errors = np.array(rows).T
    return Phases(times, columns, places, errors, steps, step_errors, float(period))
