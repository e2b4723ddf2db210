"""Place the frames of a film in the period that is sent, and fit the clock that predicts places.

Headers place the first frames, whose phases determine the clock. The clock and the chips known so
far place further frames, whose phases improve the clock.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.results.video_reading import Clock, FrameReading
from occ_model.scene.light_words import blinking_lamp
from occ_model.video.clock import describe_clock, fit_film_clock
from occ_model.video.frame_times import FrameTimes, Part, fit_frame_times
from occ_model.video.joining import JoinedChips
from occ_model.video.packets import CountedPart, PlacedFrame, unwrap_places
from occ_model.video.period import SentPeriod
from occ_model.video.phase_fit import ClockFit, FramePhases
from occ_model.video.read_frame import TimedFrame

_REFIT_GROWTH = 1.25  # growth of the number of frames after which the clock is fitted again
FIRST_FIT = 3  # minimum number of placed frames to fit the clock
_MIN_PREDICTING_FRAMES = 6  # minimum number of frames in a fit that predicts places
_ROUNDS = 4  # maximum number of rounds over unplaced frames at the end

PART_UNKNOWN = (
    "No frame shows the number of its sub-packet, and no sub-packet was completely in view."
)


class PlacedFrames:
    """Frames in the order of time, and their places, found with an approximate readout time."""

    def __init__(self, period: SentPeriod, readout_time: float, tolerance: float) -> None:
        self.joined = JoinedChips(period)
        self.clock: Clock | None = None
        self.time_step = 0.0
        self.columns = 0
        self.frames: list[TimedFrame] = []
        self.placed = 0
        self.part_unknown = False  # whether places are known only up to a number of sub-packets
        self._period = period
        self._readout_time, self._tolerance = readout_time, tolerance
        self._places: list[int | None] = []
        self._fits: tuple[ClockFit, ...] = ()
        self._next_fit, self._next_try = FIRST_FIT, _MIN_PREDICTING_FRAMES
        self._times: FrameTimes | None = None
        self._clock_first_frame = 0

    def add(self, timed: TimedFrame) -> bool:
        """Add the next frame; return whether the clock was fitted again."""
        self.frames.append(timed)
        self._places.append(None)
        self._place(len(self.frames) - 1)
        if self.placed == 0 and len(self.frames) >= self._next_try:
            self._next_try = _next_count(len(self.frames))
            self._place_within_parts()
        if self.placed < self._next_fit:
            return False
        self._next_fit = _next_count(self.placed)
        self._fit()
        self._place_others()
        return True

    def settle(self) -> None:
        """Place as many frames as possible, using all of them."""
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
        """Return the frames' times; None for fewer than two frames."""
        times = np.array([timed.reading.time for timed in self.frames])
        return fit_frame_times(times, self.time_step) if len(times) > 1 else None

    def count_parts(self) -> list[CountedPart]:
        """Return the parts of the film in the numbering of all chips sent; needs a fit."""
        times, fit = self.times(), self.fit
        assert times is not None  # noqa: S101 - a fit exists
        assert fit is not None  # noqa: S101 - the caller has checked
        return [self._count_part(fit, part) for part in times.parts]

    def _count_part(self, fit: ClockFit, part: Part) -> CountedPart:
        """Count the chips of a part by the clock, aligned to the part if fitted to another one."""
        length = self._period.length
        placed_frames = [
            (self.frames[number], place)
            for number in range(part.first, part.end)
            if (place := self._places[number]) is not None
        ]
        start_times, offsets, places = _starts_and_places(fit, placed_frames)
        if part.first <= self._clock_first_frame < part.end:
            starts = fit.at_start(start_times)
            start, end = fit.at_start(np.array([part.start, part.start + part.duration])).tolist()
        else:
            starts = fit.frequency * (start_times - part.start)
            phasor = np.exp(2j * np.pi * (places - starts - offsets) / length).sum()
            start = float(np.angle(phasor)) / (2.0 * np.pi) * length
            starts, end = starts + start, start + fit.frequency * part.duration
        firsts = unwrap_places(places, starts + offsets, length).tolist()
        frames = [
            PlacedFrame(timed.reading, first)
            for (timed, _), first in zip(placed_frames, firsts, strict=True)
        ]
        return CountedPart(frames, part.start, part.duration, (start, end))

    def _place(self, number: int) -> bool:
        timed = self.frames[number]
        if not timed.is_read:
            return False
        predicted, deviation, fit = None, 0.0, self.fit
        if (
            fit is not None
            and fit.kept.sum() >= _MIN_PREDICTING_FRAMES
            and self._is_predictable(number)
        ):
            time = timed.reading.time
            phase = float(fit.at_start(np.array([time]))[0]) + fit.step * timed.column
            predicted = (phase - timed.middle) % self._period.length
            deviation = float(np.hypot(fit.phase_error(time), timed.middle_error))
        place = self.joined.place(timed.reading, predicted, deviation, self.part_unknown)
        if place is None:
            return False
        self._record_place(number, place)
        return True

    def _is_predictable(self, number: int) -> bool:
        """Return whether the times lead without a jump from the frames of the clock to this one."""
        times = self._times
        if times is None:
            return False
        known = min(number, len(times.numbers) - 1)
        if times.part_of(known).first != self._clock_first_frame:
            return False
        since = [timed.reading.time for timed in self.frames[known : number + 1]]
        return not any(times.is_jump(after - before) for before, after in pairwise(since))

    def _record_place(self, number: int, place: int) -> None:
        self._places[number] = place
        self.placed += 1
        self.joined.add(self.frames[number].reading, place)
        if self.part_unknown:
            self._find_part()

    def _place_others(self) -> bool:
        others = [number for number, place in enumerate(self._places) if place is None]
        return sum(self._place(number) for number in others) > 0

    def _place_within_parts(self) -> None:
        """Place frames that show where a sub-packet starts but not its number.

        Their phases within a sub-packet give the clock, which gives the number of sub-packets
        between them. The number of the first one is found once all chips of any sub-packet are
        known.
        """
        length = self._period.part_length
        if self._period.parts == 1:
            return
        placed = []
        for number, timed in enumerate(self.frames):
            first, last = timed.reading.whole
            places = self._period.places(timed.reading.chips[first:last])
            if places:
                placed.append((number, (places[0] - first) % length))
        times = self.times()
        if times is None or not times.are_consecutive:
            return
        part = _fullest_part(times, (number for number, _ in placed))
        placed = [(number, place) for number, place in placed if part.first <= number < part.end]
        placed_frames = [(self.frames[number], place) for number, place in placed]
        if len(placed_frames) < _MIN_PREDICTING_FRAMES:
            return
        phases = _frame_phases(placed_frames, length)
        fits = fit_film_clock(
            phases, self._readout_time, self._tolerance, self.columns, times.period.value
        )
        if len(fits) != 1:
            return
        self.part_unknown = True
        start_times, offsets, places_in_part = _starts_and_places(fits[0], placed_frames)
        firsts = unwrap_places(
            places_in_part, fits[0].at_start(start_times) + offsets, length
        ).tolist()
        for (number, _), first, is_kept in zip(placed, firsts, fits[0].kept, strict=True):
            if is_kept:
                self._record_place(number, first % self._period.length)

    def _find_part(self) -> None:
        """Find the numbers of the sub-packets once all chips of one are known."""
        length, known = self._period.part_length, self.joined.known
        chips = (self.joined.ratios > 0.0).astype(np.uint8)
        for part in np.flatnonzero(known.reshape(-1, length).all(axis=1)).tolist():
            number_and_bits = self._period.read_part(chips[part * length : (part + 1) * length])
            if number_and_bits is not None:
                self.part_unknown = False
                shift = (number_and_bits[0] - part) * length
                self.joined.rotate(shift)
                self._places = [
                    None if place is None else (place + shift) % self._period.length
                    for place in self._places
                ]
                self._fit()
                return

    def _fit(self) -> None:
        self._fits, self.clock, times = (), None, self.times()
        if times is None or not times.are_consecutive:
            return
        placed_numbers = [
            (number, place) for number, place in enumerate(self._places) if place is not None
        ]
        part = _fullest_part(times, (number for number, _ in placed_numbers))
        part_frames = [
            (self.frames[number], chip)
            for number, chip in placed_numbers
            if part.first <= number < part.end
        ]
        if len(part_frames) < FIRST_FIT:
            return
        phases, period = _frame_phases(part_frames, self._period.length), times.period.value
        self._times, self._clock_first_frame = times, part.first
        self._fits = fit_film_clock(
            phases, self._readout_time, self._tolerance, self.columns, period
        )
        if self._fits:
            is_lamp = blinking_lamp(self._period.transmitter) is not None
            cycle = self._period.length if is_lamp else 0
            self.clock = describe_clock(self._fits, phases, times, part, self.columns, cycle)


def _fullest_part(times: FrameTimes, frames: Iterable[int]) -> Part:
    counts = np.zeros(len(times.parts), dtype=np.int64)
    ends = np.array([part.end for part in times.parts])
    np.add.at(counts, np.searchsorted(ends, np.array(list(frames), np.int64), side="right"), 1)
    return times.parts[int(counts.argmax())]


def _next_count(count: int) -> int:
    return int(np.ceil(count * _REFIT_GROWTH)) + 1


def _starts_and_places(
    fit: ClockFit, placed_frames: Sequence[tuple[TimedFrame, int]]
) -> tuple[FloatArray, FloatArray, IndexArray]:
    """Return the frames' start times, the chips from each to the first chip, and its place."""
    return (
        np.array([timed.reading.time for timed, _ in placed_frames]),
        np.array([fit.step * timed.column - timed.middle for timed, _ in placed_frames]),
        np.array([place for _, place in placed_frames], dtype=np.int64),
    )


def _frame_phases(placed_frames: Sequence[tuple[TimedFrame, int]], period: int) -> FramePhases:
    """Return the phases of frames, given the places of their first chips in a period."""
    rows = [
        (
            timed.reading.time,
            timed.column,
            (place + timed.middle) % period,
            timed.middle_error,
            timed.step,
            timed.step_error,
        )
        for timed, place in placed_frames
    ]
    times, columns, places, errors, steps, step_errors = np.array(rows).T
    return FramePhases(times, columns, places, errors, steps, step_errors, float(period))
