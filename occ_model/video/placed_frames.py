"""Place the frames of a film in the period that is sent, and fit the clock that predicts places.

Headers place the first frames, whose phases determine the clock. The clock and the chips known so
far place further frames, whose phases improve the clock.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.clock import Clock
from occ_model.results.video_reading import FrameReading
from occ_model.scene.light_words import blinking_lamp
from occ_model.video.film_clock import FilmClock, FilmFit, FilmPhases, describe_clock
from occ_model.video.frame_times import FrameTimes, Part, fit_frame_times
from occ_model.video.joining import JoinedChips
from occ_model.video.known_timing import KnownTiming
from occ_model.video.packets import CountedPart, PlacedFrame, unwrap_places
from occ_model.video.period import SentPeriod
from occ_model.video.phase_fit import FramePhases
from occ_model.video.read_frame import TimedFrame

_REFIT_GROWTH = 1.25  # growth of the number of frames after which the clock is fitted again
FIRST_FIT = 3  # minimum number of placed frames to fit the clock
_MIN_PREDICTING_FRAMES = 6  # minimum number of frames in a fit that predicts places
_ROUNDS = 4  # maximum number of rounds over unplaced frames at the end

PART_UNKNOWN = (
    "No frame shows the number of its sub-packet, and no sub-packet was completely in view."
)


class PlacedFrames:
    """Frames in the order of time, and their places."""

    def __init__(self, period: SentPeriod, known: KnownTiming, resolution: float = 0.0) -> None:
        self.joined = JoinedChips(period)
        self.clock: Clock | None = None
        self.no_clock = ""  # why there is no clock, as the end of a sentence
        self.columns = 0
        self.frames: list[TimedFrame] = []
        self.placed = 0
        self.part_unknown = False  # whether places are known only up to a number of sub-packets
        self._period, self._known, self._resolution = period, known, resolution
        self._places: list[int | None] = []
        self._clocks = FilmClock()
        self._next_fit, self._next_try = FIRST_FIT, _MIN_PREDICTING_FRAMES
        self._times: FrameTimes | None = None  # of all frames at the last fit
        self._all_times: tuple[int, FrameTimes | None] = 0, None
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
    def fit(self) -> FilmFit | None:
        return self._clocks.fits[0] if self._clocks.fits else None

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
        count, times = self._all_times
        if count != len(self.frames):
            stated = np.array([timed.reading.time for timed in self.frames])
            times = fit_frame_times(stated, self._resolution) if len(stated) > 1 else None
            self._all_times = len(self.frames), times
        return times

    def count_parts(self) -> list[CountedPart]:
        """Return the parts of the film in the numbering of all chips sent; needs a fit."""
        times, found = self.times(), self.fit
        assert times is not None  # noqa: S101 - a fit exists
        assert found is not None  # noqa: S101 - the caller has checked
        return [self._count_part(found, times, part) for part in times.parts]

    def _count_part(self, found: FilmFit, times: FrameTimes, part: Part) -> CountedPart:
        """Count the chips of a part by the clock, aligned to the part if fitted to another one."""
        length, fit = self._period.length, found.fit
        numbers = [
            number for number in range(part.first, part.end) if self._places[number] is not None
        ]
        offsets = _offsets(fit.step, [self.frames[number] for number in numbers])
        places = np.array([self._places[number] for number in numbers], dtype=np.int64)
        if found.is_by_number:
            ticks, ends = times.numbers[numbers].astype(np.float64), times.ends(part)
        else:
            ticks = np.array([self.frames[number].reading.time for number in numbers])
            ends = np.array([part.start, part.start + part.duration])
        if part.first <= self._clock_first_frame < part.end:
            starts, span = fit.at_start(ticks), fit.at_start(ends)
        else:
            starts, span = (fit.frequency * (each - ends[0]) for each in (ticks, ends))
            phasor = np.exp(2j * np.pi * (places - starts - offsets) / length).sum()
            start = float(np.angle(phasor)) / (2.0 * np.pi) * length
            starts, span = starts + start, span + start
        firsts = unwrap_places(places, starts + offsets, length).tolist()
        frames = [
            PlacedFrame(self.frames[number].reading, first)
            for number, first in zip(numbers, firsts, strict=True)
        ]
        return CountedPart(frames, part.start, part.duration, (float(span[0]), float(span[1])))

    def _place(self, number: int) -> bool:
        timed = self.frames[number]
        if not timed.is_read:
            return False
        predicted, deviation, found = None, 0.0, self.fit
        if (
            found is not None
            and found.fit.kept.sum() >= _MIN_PREDICTING_FRAMES
            and self._is_predictable(number)
        ):
            tick, fit = self._tick(found, number), found.fit
            phase = float(fit.at_start(np.array([tick]))[0]) + fit.step * timed.column
            predicted = (phase - timed.middle) % self._period.length
            deviation = float(np.hypot(fit.phase_error(tick), timed.middle_error))
        place = self.joined.place(timed.reading, predicted, deviation, self.part_unknown)
        if place is None:
            return False
        self._record_place(number, place)
        return True

    def _tick(self, found: FilmFit, number: int) -> float:
        """Return when a frame begins, in ticks of a clock; its times need not hold the frame."""
        time, times = self.frames[number].reading.time, self._times
        if times is None or not found.is_by_number:
            return time
        known = min(number, len(times.numbers) - 1)
        later = (time - self.frames[known].reading.time) / times.period.value
        return float(times.numbers[known] + np.rint(later))

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
        numbers = [number for number, _ in placed]
        phases = _frame_phases(placed_frames, length)
        film = FilmPhases(phases, times.numbers[numbers], times, self._known, self.columns)
        clocks = film.fit_clocks()
        if len(clocks.fits) != 1:
            return
        self.part_unknown = True
        fit = clocks.fits[0].fit
        offsets = _offsets(fit.step, [timed for timed, _ in placed_frames])
        places_in_part = np.array([place for _, place in placed], dtype=np.int64)
        ticks = film.ticks(clocks.fits[0].is_by_number)
        firsts = unwrap_places(places_in_part, fit.at_start(ticks) + offsets, length).tolist()
        for number, first, is_kept in zip(numbers, firsts, fit.kept, strict=True):
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
        self._clocks, self.clock, times = FilmClock(), None, self.times()
        if times is None or not times.are_consecutive:
            self.no_clock = "the frame times do not increase, or jump too often."
            return
        placed = [number for number, place in enumerate(self._places) if place is not None]
        part = _fullest_part(times, placed)
        numbers = [number for number in placed if part.first <= number < part.end]
        if len(numbers) < FIRST_FIT:
            return
        frames = [(self.frames[number], self._places[number] or 0) for number in numbers]
        phases = _frame_phases(frames, self._period.length)
        self._times, self._clock_first_frame = times, part.first
        film = FilmPhases(phases, times.numbers[numbers], times, self._known, self.columns)
        self._clocks = film.fit_clocks()
        self.no_clock = self._clocks.reason
        if self._clocks.fits:
            is_lamp = blinking_lamp(self._period.transmitter) is not None
            cycle = self._period.length if is_lamp else 0
            self.clock = describe_clock(self._clocks, film, part, cycle)


def _fullest_part(times: FrameTimes, frames: Iterable[int]) -> Part:
    counts = np.zeros(len(times.parts), dtype=np.int64)
    ends = np.array([part.end for part in times.parts])
    np.add.at(counts, np.searchsorted(ends, np.array(list(frames), np.int64), side="right"), 1)
    return times.parts[int(counts.argmax())]


def _next_count(count: int) -> int:
    return int(np.ceil(count * _REFIT_GROWTH)) + 1


def _offsets(step: float, frames: Sequence[TimedFrame]) -> FloatArray:
    """Return the chips from each frame's start to its first chip."""
    return np.array([step * timed.column - timed.middle for timed in frames])


def _frame_phases(placed_frames: Sequence[tuple[TimedFrame, int]], period: int) -> FramePhases:
    """Return the phases of frames, given the places of their first chips in a period."""
    frames = (
        (
            timed.reading.time, timed.column, (place + timed.middle) % period, timed.middle_error,
            timed.step, timed.step_error,
        )
        for timed, place in placed_frames
    )  # fmt: skip
    return FramePhases.of(frames, float(period))
