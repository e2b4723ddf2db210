"""Join the frames of a film as they arrive: its chips, its packets and its clock."""

from dataclasses import replace

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.camera.pixel_arrays import bytes_of, white_of
from occ_model.errors import DecodeInputError, ParameterError, quote
from occ_model.plugins import Faults
from occ_model.receiver.decode import decoder_named
from occ_model.receiver.sequence.soft_frame import SoftFrame, read_frame as read_soft_frame
from occ_model.results.decoding import PAPER_DECODER, overexposed_text
from occ_model.results.sent_packets import SentPackets
from occ_model.results.video import LATEST_TIME, FilmTimes, VideoFrame
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.scene.argument_checks import check_count
from occ_model.scene.light_words import CYCLIC_LIGHTS
from occ_model.scene.parameters import quantity
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.scheme import check_code, code_of
from occ_model.video.frame_times import FrameTimes
from occ_model.video.known_timing import READOUT_TOLERANCE, KnownTiming, known_timing
from occ_model.video.packets import count_packets
from occ_model.video.payload_so_far import (
    NO_CLOCK,
    certainty_of,
    explain_unplaced,
    explain_unread,
    format_bits,
    known_bits,
)
from occ_model.video.period import SentPeriod
from occ_model.video.placed_frames import PART_UNKNOWN, PlacedFrames
from occ_model.video.read_frame import FrameReader
from occ_model.video.without_packets import WithoutPackets

_MIN_PLACED_FRACTION = 0.9  # of a lamp's frames, in which its edges give a more exact clock


def _half_cycles_as_chips(scene: Scene, known: KnownTiming) -> Scene:
    """Return a lamp as alternating chips, in which a few of its cycles are recognized as well."""
    declared = quantity("switching_frequency")
    frequency = min(max(known.frequency, declared.low), declared.high)
    return scene.replace(light="code", pattern="10", switching_frequency=frequency)


class VideoReader:
    """Reads a film as its frames arrive.

    It keeps the chips of each frame, about 2 kB, but not its picture.

    Parameters
    ----------
    scene, decoder, readout_tolerance, frequency_tolerance
        As for :func:`occ_model.decode_video`.
    times
        What is known of the frames' times: how far they are rounded.
    """

    def __init__(
        self,
        scene: Scene,
        decoder: str = PAPER_DECODER,
        *,
        readout_tolerance: float | None = None,
        frequency_tolerance: float | None = None,
        times: FilmTimes = FilmTimes(),  # noqa: B008 - it is frozen
    ) -> None:
        check_scene(scene)
        self._is_lamp = scene.transmitter.light in CYCLIC_LIGHTS
        if not self._is_lamp:
            check_code(scene.transmitter)
        decoder_named(decoder)
        known = known_timing(scene, readout_tolerance, frequency_tolerance)
        self._scene_light = scene.transmitter.light
        if self._is_lamp:
            scene = _half_cycles_as_chips(scene, known)
        self._scene, self._frame_reader = scene, FrameReader(scene, decoder)
        self._period = SentPeriod(scene.transmitter)
        self._placed = PlacedFrames(self._period, known, times.resolution)
        self._joined = self._placed.joined
        self._without_packets = WithoutPackets(known if self._is_lamp else known.without_frequency)
        self._chips_in_view = -1
        self._shape: tuple[int, ...] | None = None
        self._white: float | None = None  # the value of white in the first frame
        self._completing_frame: int | None = None
        self._payload, self._faults = "", Faults()
        self.notes: tuple[str, ...] = ()  # Sentences on the film that precede the problems found

    def add(self, frame: VideoFrame) -> FilmProgress:
        """Read the next frame.

        Returns
        -------
        FilmProgress
            What is known after this frame.

        Raises
        ------
        ParameterError
            It is not a frame, its time is not a number from -1e8 to 1e8 s, or its picture is
            invalid or has another size than the first one. The earlier frames are kept.
        """
        frame, white = self._check_frame(frame)
        with self._faults.counting():
            timed = self._frame_reader.read(frame)
        self._shape, self._placed.columns = frame.image.shape, frame.image.shape[1]
        self._white = white
        if self._placed.add(timed):
            self._chips_in_view = -1
        if self._is_lamp or self._placed.placed == 0:
            self._without_packets.add(frame.time, frame.image, timed.reading.region)
        self._update_payload()
        frames = len(self._placed.frames)
        return FilmProgress(
            frame=self._placed.reading(frames - 1),
            frames=frames,
            placed=0 if self._placed.part_unknown else self._placed.placed,
            payload=self._payload,
            known=float(self._joined.known.mean()),
            complete=self._completing_frame is not None,
            clock=self._placed.clock,
        )

    def reading(self) -> VideoReading:
        """Return the result of all frames so far together."""
        placed = self._placed
        placed.settle()
        self._chips_in_view = -1
        self._update_payload()
        soft = self._read_soft_frame()
        failure = self._explain_failure(soft)
        if failure is not None:  # overexposure need not be the cause
            white = float(np.mean([frame.white for frame in placed.frames] or [0.0]))
            failure += f" {overexposed_text(white)}" if white else ""
        bits = soft.framed.bits if soft is not None and failure is None else np.empty(0, np.uint8)
        times, clock, no_clock = placed.times(), placed.clock, placed.no_clock
        is_followed = clock is not None and placed.placed >= _MIN_PLACED_FRACTION * len(
            placed.frames
        )
        if placed.columns and (placed.placed == 0 or (self._is_lamp and not is_followed)):
            lamp_clock, no_lamp_clock = self._without_packets.fit_clock(times, placed.columns)
            if lamp_clock is not None or clock is None:
                clock, no_clock = lamp_clock, no_lamp_clock or no_clock
        if self._is_lamp and clock is not None:
            failure = None
            if self._scene_light == "mains":
                # Its few and soft stripes show only phases exactly.
                clock = clock.widen_readout(READOUT_TOLERANCE, placed.columns)
        number = self._completing_frame if failure is None else None
        return VideoReading(
            frames=tuple(placed.reading(number) for number in range(len(placed.frames))),
            packets=self._count_packets(bits),
            clock=clock,
            bits=bits,
            known=self._joined.known,
            payload=self._format_payload(bits) if bits.size else "",
            certainty=certainty_of(soft, self._period),
            complete_at=None if number is None else placed.frames[number].reading.time,
            duration=0.0 if times is None else sum(part.duration for part in times.parts),
            failure=failure,
            problems=(
                *self.notes,
                *(self._describe_problems(times, no_clock) if clock is None else clock.problems),
            ),
            faults=str(self._faults),
            complete_after=None
            if number is None or times is None or placed.clock is None
            else times.elapsed(number),
        )

    def _describe_problems(self, times: FrameTimes | None, no_clock: str) -> tuple[str, ...]:
        """Report irregular times of frames that do not determine a clock, and why there is none."""
        problems = () if times is None else times.problems
        if times is None and len(self._placed.frames) > 1:
            problems = ("The frame times do not increase.",)
        no_packets = "" if self._is_lamp else ", so that packets are not counted"
        return (*problems, f"{NO_CLOCK}{no_packets}: {no_clock}") if no_clock else problems

    def _check_frame(self, frame: VideoFrame) -> tuple[VideoFrame, float | None]:
        """Return a frame in bytes and the value of white; refuse one unlike the earlier frames."""
        if not isinstance(frame, VideoFrame):
            raise ParameterError.of("frame", quote(frame), "a VideoFrame")
        check_count("index of a frame", frame.index, 0)
        image: object = frame.image
        name = f"image of frame {frame.index}"
        if not isinstance(image, np.ndarray) or image.ndim != 2:
            kind = f"{image.dtype} {image.shape}" if isinstance(image, np.ndarray) else quote(image)
            raise ParameterError.of(name, kind, "pixels (rows, columns)")
        if self._shape not in (None, image.shape):
            raise ParameterError(
                f"{name} has the shape {image.shape}; allowed: that of the first frame, "
                f"{self._shape}."
            )
        try:
            white = self._white or white_of(image, name)
            pixels = bytes_of(image, name, white)
        except DecodeInputError as error:
            raise ParameterError(str(error)) from None
        time: object = frame.time
        if not isinstance(time, int | float | np.number) or not abs(float(time)) <= LATEST_TIME:
            raise ParameterError.of(
                f"time of frame {frame.index}",
                f"{quote(time)} s",
                f"{-LATEST_TIME:g} to {LATEST_TIME:g} s",
            )
        return replace(frame, image=pixels), white

    def _update_payload(self) -> None:
        """Read the payload again if more chips have come into view."""
        chips_in_view = int(self._joined.seen.sum())
        if chips_in_view == self._chips_in_view or self._period.scheme is None:
            return
        self._chips_in_view = chips_in_view
        soft = self._read_soft_frame()
        if soft is not None and self._explain_failure(soft) is None:
            self._payload = self._format_payload(soft.framed.bits)
            if self._completing_frame is None:
                self._completing_frame = len(self._placed.frames) - 1
        else:
            bits = known_bits(self._joined.ratios, self._joined.known, self._period)
            self._payload = format_bits(bits, self._scene)

    def _read_soft_frame(self) -> SoftFrame | None:
        scheme = self._period.scheme
        if scheme is None or not self._joined.known.all():
            return None
        return read_soft_frame(self._joined.ratios, scheme, self._period.header)

    def _explain_failure(self, soft: SoftFrame | None) -> str | None:
        if self._is_lamp:
            description = self._without_packets.describe(self._scene.camera.readout_time)
            return description or "No frame shows stripes that repeat, as those of a lamp do."
        if self._placed.placed == 0:
            description = self._without_packets.describe(self._scene.camera.readout_time)
            if not description:
                return explain_unplaced(self._placed.frames)
            if self._without_packets.may_be_packets:
                return f"{description} {explain_unplaced(self._placed.frames)}"
            return f"{description} No frame contains packets as the scene sends them."
        if self._placed.part_unknown:
            return PART_UNKNOWN
        return explain_unread(soft, self._joined.known, self._period)

    def _format_payload(self, bits: ByteArray) -> str:
        payload = self._scene.transmitter.payload
        if payload:
            return payload_of_bits(bits.tolist(), form_of(payload))
        return str(code_of(bits.tolist()))

    def _count_packets(self, bits: ByteArray) -> SentPackets:
        fit = self._placed.fit
        if fit is None or self._period.scheme is None or self._placed.part_unknown:
            return SentPackets()
        return count_packets(self._placed.count_parts(), self._period, bits, fit.stated_frequency)
