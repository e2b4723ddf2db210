"""The reader of a film: it takes frames as they come, and says what they tell together."""

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError, shown
from occ_model.receiver.decoders import PAPER_DECODER, decoder_named
from occ_model.receiver.sequence.soft_frame import SoftFrame
from occ_model.receiver.sequence.soft_frame import read_frame as read_soft_frame
from occ_model.results.video import VideoFrame
from occ_model.results.video_reading import (
    FilmProgress,
    PacketReading,
    VideoReading,
)
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.packet import code_of
from occ_model.video.clock import READOUT_TOLERANCE
from occ_model.video.failures import certainty_of, why_not_read, why_unplaced
from occ_model.video.packets import packets_of
from occ_model.video.partial_payload import known_bits, written
from occ_model.video.period import period_of
from occ_model.video.placed_frames import PlacedFrames
from occ_model.video.read_frame import FrameReader


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
        self._scene, self._reads = scene, FrameReader(scene, decoder)
        self._period = period_of(scene)
        readout = scene.camera.readout_time
        self._placed = PlacedFrames(self._period, readout, readout_tolerance)
        self._joined = self._placed.joined
        self._seen = -1
        self._complete_at: float | None = None
        self._payload = ""

    @property
    def time_step(self) -> float:
        """The step that frame times are whole multiples of, in seconds; 0 if they are exact."""
        return self._placed.time_step

    @time_step.setter
    def time_step(self, step: float) -> None:
        self._placed.time_step = step

    def add(self, frame: VideoFrame) -> FilmProgress:
        """Read the next frame.

        Returns
        -------
        FilmProgress
            What is known now.
        """
        self._placed.columns = frame.image.shape[1]
        if self._placed.add(self._reads.read(frame)):
            self._seen = -1
        self._read_on(frame.time)
        frames = len(self._placed.frames)
        return FilmProgress(
            frame=self._placed.reading(frames - 1),
            frames=frames,
            placed=self._placed.placed,
            payload=self._payload,
            known=float(self._joined.known.mean()),
            complete=self._complete_at is not None,
            clock=self._placed.clock,
        )

    def reading(self) -> VideoReading:
        """Return what the frames so far say together."""
        placed = self._placed
        placed.settle()
        self._seen = -1
        self._read_on(placed.frames[-1].reading.time if placed.frames else 0.0)
        soft = self._soft_frame()
        failure = self._failure(soft)
        bits = soft.framed.bits if soft is not None and failure is None else np.empty(0, np.uint8)
        return VideoReading(
            frames=tuple(placed.reading(number) for number in range(len(placed.frames))),
            packets=self._packets(bits),
            clock=placed.clock,
            bits=bits,
            known=self._joined.known,
            payload=self._written(bits) if bits.size else "",
            certainty=certainty_of(soft, self._period),
            complete_at=self._complete_at if failure is None else None,
            duration=self._duration(),
            failure=failure,
        )

    def _read_on(self, time: float) -> None:
        """Read the payload anew where chips have come into view."""
        seen = int(self._joined.seen.sum())
        if seen == self._seen or self._period.scheme is None:
            return
        self._seen = seen
        soft = self._soft_frame()
        if soft is not None and self._failure(soft) is None:
            self._payload = self._written(soft.framed.bits)
            self._complete_at = time if self._complete_at is None else self._complete_at
        else:
            self._payload = written(known_bits(self._joined, self._period), self._scene)

    def _soft_frame(self) -> SoftFrame | None:
        scheme = self._period.scheme
        if scheme is None or not self._joined.known.all():
            return None
        return read_soft_frame(self._joined.ratios, scheme, self._period.header)

    def _failure(self, soft: SoftFrame | None) -> str | None:
        """Say why the payload is not read."""
        if self._placed.placed == 0:
            return why_unplaced(self._placed.frames)
        return why_not_read(soft, self._joined, self._period)

    def _written(self, bits: ByteArray) -> str:
        payload = self._scene.transmitter.payload
        if payload:
            return payload_of_bits(bits.tolist(), form_of(payload))
        return str(code_of(bits.tolist()))

    def _duration(self) -> float:
        """Return the time from the first frame's start to the end of the last one's period."""
        times = self._placed.times()
        return float(times.numbers[-1] + 1) * times.period.value if times is not None else 0.0

    def _packets(self, bits: ByteArray) -> tuple[PacketReading, ...]:
        fit = self._placed.fit
        if fit is None or self._period.scheme is None:
            return ()
        begin = self._placed.frames[0].reading.time
        first, last = fit.at_start(np.array([begin, begin + self._duration()])).tolist()
        chip = 1.0 / fit.frequency
        times = begin - first * chip, chip
        return packets_of(self._placed.counted(), self._period, bits, (first, last), times)
