"""The frames of a film, each at its place in what is sent, and the clock that foretells places.

Headers place the first frames; their phases give the clock; the clock and the chips that are known
by then place others, whose phases improve the clock.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from occ_model.results.video_reading import Clock, FrameReading
from occ_model.video.clock import fits_of, state
from occ_model.video.frame_times import FrameTimes, frame_times
from occ_model.video.joining import Joined, Place
from occ_model.video.packets import PlacedFrame, counted_on
from occ_model.video.period import SentPeriod
from occ_model.video.phases import ClockFit, Phases
from occ_model.video.read_frame import TimedFrame

_REFIT = 1.25
"""Factor of the number of frames after which the clock is fitted anew."""

_FIRST_FIT = 3
"""Placed frames from which the clock is fitted."""

_FORETELLING = 6
"""Frames of a fit from which it foretells the places of others."""

_ROUNDS = 4
"""Most rounds in which frames that were not placed are tried again at the end."""


class PlacedFrames:
    """Frames, in the order of time, and their places.

    Parameters
    ----------
    period
        What is sent.
    readout_time, tolerance
        A rough readout time in seconds, and the share by which it may be wrong.
    """

    def __init__(self, period: SentPeriod, readout_time: float, tolerance: float) -> None:
        self.joined = Joined(period)
        self.clock: Clock | None = None
        self.time_step = 0.0
        self.columns = 0
        self.frames: list[TimedFrame] = []
        self.placed = 0
        self._period = period
        self._readout_time, self._tolerance = readout_time, tolerance
        self._places: list[Place | None] = []
        self._fits: tuple[ClockFit, ...] = ()
        self._next_fit, self._next_try = _FIRST_FIT, _FORETELLING
        self._part_unknown = False

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
        """The likeliest fit of the clock."""
        return self._fits[0] if self._fits else None

    def reading(self, number: int) -> FrameReading:
        """Return a frame's reading with its place."""
        reading, place = self.frames[number].reading, self._places[number]
        if place is not None:
            return replace(reading, place=place.chip)
        if reading.failure is not None:
            return reading
        return replace(
            reading,
            failure="The frame shows no header, and its place in the packet is not known.",
        )

    def times(self) -> FrameTimes | None:
        """Return the frames' times; None of fewer than two."""
        times = np.array([timed.reading.time for timed in self.frames])
        return frame_times(times, self.time_step) if len(times) > 1 else None

    def counted(self) -> list[PlacedFrame]:
        """Return the frames that are placed, on the count of all chips sent; needs a fit."""
        fit = self.fit
        assert fit is not None  # noqa: S101 - the caller has asked
        both = [
            (timed, place.chip)
            for timed, place in zip(self.frames, self._places, strict=True)
            if place is not None
        ]
        firsts = self._counted(fit, both, self._period.length)
        return [
            PlacedFrame(timed.reading, first)
            for (timed, _), first in zip(both, firsts, strict=True)
        ]

    def _counted(
        self, fit: ClockFit, both: Sequence[tuple[TimedFrame, int]], period: int
    ) -> list[int]:
        """Count the places of frames on over periods, by the clock."""
        start = fit.at_start(np.array([timed.reading.time for timed, _ in both]))
        inside = np.array([fit.step * timed.column - timed.middle for timed, _ in both])
        places = np.array([place for _, place in both], dtype=np.int64)
        return [int(first) for first in counted_on(places, start + inside, period)]

    def _place(self, number: int) -> bool:
        """Place one frame, if it can be placed by now."""
        timed = self.frames[number]
        if not timed.is_read:
            return False
        foretold, deviation, fit = None, 0.0, self.fit
        if fit is not None and fit.kept.sum() >= _FORETELLING:
            time = timed.reading.time
            phase = float(fit.at_start(np.array([time]))[0]) + fit.step * timed.column
            foretold = (phase - timed.middle) % self._period.length
            deviation = float(np.hypot(fit.phase_error(time), timed.middle_error))
        place = self.joined.place(timed.reading, foretold, deviation, self._part_unknown)
        if place is None:
            return False
        self._enter(number, place)
        return True

    def _enter(self, number: int, place: Place) -> None:
        self._places[number] = place
        self.placed += 1
        self.joined.add(self.frames[number].reading, place.chip)
        if self._part_unknown:
            self._find_part()

    def _place_others(self) -> bool:
        """Try the frames again that were not placed; return whether any was."""
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
        both = [(self.frames[number], place) for number, place in shown]
        times = self.times()
        if times is None or len(both) < _FORETELLING:
            return
        phases = _phases(both, length)
        fits = fits_of(
            phases, self._readout_time, self._tolerance, self.columns, times.period.value
        )
        if len(fits) != 1:
            return
        self._part_unknown = True
        firsts = self._counted(fits[0], both, length)
        for (number, _), first, kept in zip(shown, firsts, fits[0].kept, strict=True):
            if kept:
                self._enter(number, Place(first % self._period.length, is_confirmed=True))

    def _find_part(self) -> None:
        """Find which sub-packet is which, once all chips of one are known."""
        length, known = self._period.part_length, self.joined.known
        chips = (self.joined.ratios > 0.0).astype(np.uint8)
        for part in np.flatnonzero(known.reshape(-1, length).all(axis=1)).tolist():
            found = self._period.part_bits(chips[part * length : (part + 1) * length])
            if found is not None:
                self._part_unknown = False
                shift = (found[0] - part) * length
                self.joined.rotate(shift)
                self._places = [
                    None if place is None
                    else replace(place, chip=(place.chip + shift) % self._period.length)
                    for place in self._places
                ]  # fmt: skip
                self._fit()
                return

    def _fit(self) -> None:
        both = [
            (timed, place.chip)
            for timed, place in zip(self.frames, self._places, strict=True)
            if place is not None and place.is_confirmed
        ]
        times = self.times()
        if times is None or len(both) < _FIRST_FIT:
            return
        phases, period = _phases(both, self._period.length), times.period.value
        self._fits = fits_of(phases, self._readout_time, self._tolerance, self.columns, period)
        self.clock = state(self._fits, phases, times, self.columns) if self._fits else None


def _later(count: int) -> int:
    return int(np.ceil(count * _REFIT)) + 1


def _phases(both: Sequence[tuple[TimedFrame, int]], period: int) -> Phases:
    """Return the phases of frames whose first chip's place is known within a period."""
    frames = [timed for timed, _ in both]
    return Phases(
        times=np.array([timed.reading.time for timed in frames]),
        columns=np.array([timed.column for timed in frames]),
        places=np.mod([place + timed.middle for timed, place in both], period),
        errors=np.array([timed.middle_error for timed in frames]),
        steps=np.array([timed.step for timed in frames]),
        step_errors=np.array([timed.step_error for timed in frames]),
        period=float(period),
    )
