"""The reader of a film: it takes frames as they come, and says what they tell together."""

from dataclasses import replace

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError, shown
from occ_model.receiver.decoders import PAPER_DECODER, decoder_named
from occ_model.receiver.sequence.soft_frame import SoftFrame
from occ_model.receiver.sequence.soft_frame import read_frame as read_soft_frame
from occ_model.results.video import VideoFrame
from occ_model.results.video_reading import (
    Clock,
    FilmProgress,
    FrameReading,
    PacketReading,
    VideoReading,
)
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.packet import code_of
from occ_model.video.clock import READOUT_TOLERANCE, fits_of, state
from occ_model.video.failures import why_not_read, why_unplaced
from occ_model.video.frame_times import FrameTimes, frame_times
from occ_model.video.joining import Joined, Place
from occ_model.video.packets import PlacedFrame, counted_on, packets_of
from occ_model.video.partial_payload import known_bits, written
from occ_model.video.period import period_of
from occ_model.video.phases import ClockFit, Phases
from occ_model.video.read_frame import TimedFrame, film_scene, read_frame

_REFIT = 1.25
"""Factor of the number of placed frames after which the clock is fitted anew."""

_FIRST_FIT = 3
"""Placed frames from which the clock is fitted."""

_FORETELLING = 6
"""Frames of a fit from which it foretells the places of others."""

_ROUNDS = 4
"""Most rounds in which frames that were not placed are tried again at the end."""


class VideoReader:
    """Reads a film as its frames come.

    It keeps the chips of each frame, not its picture: about 2 kB a frame.

    Parameters
    ----------
    scene, decoder, readout_tolerance
        As for :func:`decode_video`.
    """

    def __init__(
        self,
        scene: Scene,
        decoder: str = PAPER_DECODER,
        *,
        readout_tolerance: float = READOUT_TOLERANCE,
    ) -> None:
        check_scene(scene)
        decoder_named(decoder)
        if not 0.0 < readout_tolerance <= 0.5:
            raise ParameterError(
                f"readout_tolerance is {shown(readout_tolerance)}; allowed: above 0 up to 0.5."
            )
        self.time_step = 0.0
        """The step that frame times are whole multiples of, in seconds, 0 if they are exact."""
        self._scene, self._decoder = film_scene(scene), decoder
        self._tolerance = readout_tolerance
        self._period = period_of(scene)
        self._joined = Joined(self._period)
        self._frames: list[TimedFrame] = []
        self._places: list[Place | None] = []
        self._columns = 0
        self._fits: tuple[ClockFit, ...] = ()
        self._next_fit = _FIRST_FIT
        self._clock: Clock | None = None
        self._seen = -1
        self._complete_at: float | None = None
        self._payload = ""

    def add(self, frame: VideoFrame) -> FilmProgress:
        """Read the next frame.

        Returns
        -------
        FilmProgress
            What is known now.
        """
        timed = read_frame(frame, self._scene, self._decoder)
        self._columns = frame.image.shape[1]
        self._frames.append(timed)
        self._places.append(None)
        self._place(len(self._frames) - 1)
        if self._placed() >= self._next_fit:
            self._next_fit = int(np.ceil(self._placed() * _REFIT)) + 1
            self._fit()
            self._place_others()
        self._read_on(frame.time)
        return FilmProgress(
            frame=self._reading(len(self._frames) - 1),
            frames=len(self._frames),
            placed=self._placed(),
            payload=self._payload,
            known=self._known(),
            complete=self._complete_at is not None,
            clock=self._clock,
        )

    def reading(self) -> VideoReading:
        """Return what the frames so far say together."""
        for _ in range(_ROUNDS):
            self._fit()
            if not self._place_others():
                break
        last = self._frames[-1].reading.time if self._frames else 0.0
        self._read_on(last)
        soft = self._soft_frame()
        failure = self._failure(soft)
        bits = soft.framed.bits if soft is not None and failure is None else np.empty(0, np.uint8)
        payload = self._written(bits) if bits.size else ""
        return VideoReading(
            frames=tuple(self._reading(number) for number in range(len(self._frames))),
            packets=self._packets(bits),
            clock=self._clock,
            bits=bits,
            known=self._joined.seen,
            payload=payload,
            certainty=soft.certainty if soft is not None else 0.0,
            complete_at=self._complete_at if failure is None else None,
            duration=self._duration(),
            failure=failure,
        )

    def _placed(self) -> int:
        return sum(place is not None for place in self._places)

    def _known(self) -> float:
        return float((self._joined.seen | (self._period.known != 0)).mean())

    def _place(self, number: int) -> bool:
        """Place one frame, if it can be placed by now."""
        timed = self._frames[number]
        if not timed.is_read:
            return False
        foretold, deviation = None, 0.0
        if self._fits and self._fits[0].kept.sum() >= _FORETELLING:
            fit, time = self._fits[0], timed.reading.time
            phase = float(fit.at_start(np.array([time]))[0]) + fit.step * timed.column
            foretold = (phase - timed.middle) % self._period.length
            deviation = float(np.hypot(fit.phase_error(time), timed.middle_error))
        place = self._joined.place(timed.reading, foretold, deviation)
        if place is None:
            return False
        self._places[number] = place
        self._joined.add(timed.reading, place.chip)
        return True

    def _place_others(self) -> bool:
        """Try the frames again that were not placed; return whether any was."""
        others = [number for number, place in enumerate(self._places) if place is None]
        return sum(self._place(number) for number in others) > 0

    def _times(self) -> FrameTimes | None:
        times = np.array([timed.reading.time for timed in self._frames])
        return frame_times(times, self.time_step) if len(times) > 1 else None

    def _phases(self) -> Phases:
        placed = [
            (timed, place.chip)
            for timed, place in zip(self._frames, self._places, strict=True)
            if place is not None and place.is_confirmed
        ]
        frames = [timed for timed, _ in placed]
        places = np.array([place + timed.middle for timed, place in placed])
        return Phases(
            times=np.array([timed.reading.time for timed in frames]),
            columns=np.array([timed.column for timed in frames]),
            places=np.mod(places, self._period.length),
            errors=np.array([timed.middle_error for timed in frames]),
            steps=np.array([timed.step for timed in frames]),
            step_errors=np.array([timed.step_error for timed in frames]),
            period=float(self._period.length),
        )

    def _fit(self) -> None:
        times = self._times()
        phases = self._phases()
        if times is None or len(phases.times) < _FIRST_FIT:
            return
        readout = self._scene.camera.readout_time
        period = times.period.value
        self._fits = fits_of(phases, readout, self._tolerance, self._columns, period)
        self._clock = state(self._fits, phases, times, self._columns) if self._fits else None

    def _read_on(self, time: float) -> None:
        """Read the payload anew where chips have come into view."""
        seen = int(self._joined.seen.sum())
        if seen == self._seen or self._period.scheme is None:
            return
        self._seen = seen
        soft = self._soft_frame() if self._known() == 1.0 else None
        if soft is not None and self._failure(soft) is None:
            self._payload = self._written(soft.framed.bits)
            self._complete_at = time if self._complete_at is None else self._complete_at
        else:
            self._payload = written(known_bits(self._joined, self._period), self._scene)

    def _soft_frame(self) -> SoftFrame | None:
        scheme = self._period.scheme
        if scheme is None or self._known() < 1.0:
            return None
        return read_soft_frame(self._joined.ratios, scheme, self._period.header)

    def _failure(self, soft: SoftFrame | None) -> str | None:
        """Say why the payload is not read."""
        if self._placed() == 0:
            return why_unplaced([timed.reading for timed in self._frames])
        return why_not_read(soft, self._joined, self._period)

    def _written(self, bits: ByteArray) -> str:
        payload = self._scene.transmitter.payload
        if payload:
            return payload_of_bits(bits.tolist(), form_of(payload))
        return str(code_of(bits.tolist()))

    def _reading(self, number: int) -> FrameReading:
        reading, place = self._frames[number].reading, self._places[number]
        if place is not None:
            return replace(reading, place=place.chip)
        if reading.failure is not None:
            return reading
        return replace(
            reading,
            failure="The frame shows no header, and its place in the packet is not known.",
        )

    def _duration(self) -> float:
        """Return the time from the first frame's start to the end of the last one's period."""
        times = self._times()
        if times is None:
            return 0.0
        return float(times.numbers[-1] + 1) * times.period.value

    def _packets(self, bits: ByteArray) -> tuple[PacketReading, ...]:
        times = self._times()
        if not self._fits or times is None or self._period.scheme is None:
            return ()
        fit, length = self._fits[0], self._period.length
        both = [
            (timed, place.chip)
            for timed, place in zip(self._frames, self._places, strict=True)
            if place is not None
        ]
        frames, places = [timed for timed, _ in both], np.array([place for _, place in both])
        start = fit.at_start(np.array([timed.reading.time for timed in frames]))
        inside = np.array([fit.step * timed.column - timed.middle for timed in frames])
        firsts = counted_on(places, start + inside, length)
        placed = [
            PlacedFrame(timed.reading, first)
            for timed, first in zip(frames, firsts.tolist(), strict=True)
        ]
        begin = self._frames[0].reading.time
        ends = fit.at_start(np.array([begin, begin + self._duration()]))
        chip = 1.0 / fit.frequency
        first = begin - float(ends[0]) * chip
        return packets_of(
            placed, self._period, bits, (float(ends[0]), float(ends[1])), (first, chip)
        )
