"""Open a film's file, and read its frames on demand as grey levels along the scan axis."""

import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import cv2
import numpy as np

from occ_model.errors import ParameterError, SceneFileError, VideoError, inflect, one_line, quote
from occ_model.files.reading import FIRST_BYTES, container_of, read_start
from occ_model.photo.reading.choices import SCAN_AXES
from occ_model.photo.reading.load import roughness_along
from occ_model.results.video import LATEST_TIME, FilmTimes, Video, VideoFrame
from occ_model.scene.argument_checks import check_choice, check_count
from occ_model.scene.provenance import first_scene_in
from occ_model.scene.recording import Recording
from occ_model.video.file.decoder_main import NO_MEMORY
from occ_model.video.file.decoder_process import (
    DecoderProcess,
    DecoderStoppedError,
    put_back,
    take_decoder,
)
from occ_model.video.file.note import read_note
from occ_model.video.file.source import CHANNELS, FilmFacts, StoredFrame

_MAX_DECODED_AHEAD = 10  # frames; frames further ahead are found by their times
_MAX_END_STEPS = 2.0  # from a complete film's last frame to its end, in longest frame steps
_LEVEL_OF_16_BITS = 255.0 / 65535.0
_SCAN_AXIS_FRAMES = 5  # frames at a film's start from which the scan axis is found


def load_video(path: str | Path, scan_axis: str = "auto", *, channel: str = "luma") -> "VideoFile":
    """Open a film.

    Its frames are read on demand, in a separate process that ends with this one; only the current
    frame is kept.

    Parameters
    ----------
    path
        A file of one of the kinds in :mod:`occ_model.files.reading`, recognized by its content.
        Frames are turned upright, and their levels are 0 to 255, whatever range the file uses.
    scan_axis
        ``"columns"`` or ``"lines"`` of the film, or ``"auto"``: found from the first frames and
        used for all.
    channel
        ``"luma"``, ``"red"``, ``"green"`` or ``"blue"``; or ``"colours"``: images of all three, of
        shape (rows, columns, 3), unless the file stores grey alone. Most files store the luma
        of each pixel, but the colours of only four pixels together.

    Raises
    ------
    VideoError
        There is no such file, or it or all of its frames cannot be read.
    ParameterError
        ``scan_axis`` or ``channel`` is not one of these words.
    """
    check_choice("scan_axis", scan_axis, SCAN_AXES)
    check_choice("channel", channel, CHANNELS)
    try:
        file = Path(path)
    except TypeError:
        raise VideoError(
            f"{quote(path)} is not the path of a film; allowed: str or Path."
        ) from None
    return VideoFile(file, scan_axis, channel)


class VideoFile(Video):
    """A film in a file: see :func:`load_video`; ``turned``: its lines became the columns."""

    path: Path

    def __init__(self, path: Path, scan_axis: str, channel: str) -> None:
        self.path = path
        self.title = path.name
        self._name = one_line(str(path))
        self._channel = channel
        try:
            start = read_start(path, FIRST_BYTES)
        except SceneFileError as error:  # its text suits any file
            raise VideoError(str(error)) from None
        self._container = container_of(path, start)
        self._problem: str | None = None
        self._times: list[float] = []
        # The last requested frame, and the decoder, which is positioned after it.
        self._current: tuple[DecoderProcess, VideoFrame] | None = None
        self._lock = threading.Lock()
        self._read_first_frames(scan_axis)
        self._read_note()

    @property
    def problem(self) -> str | None:
        """A sentence if the film, as far as it was read, is damaged or ends early; else None."""
        return self._problem

    def frames(self, first: int = 0) -> Iterator[VideoFrame]:
        """Read the frames in order, from the one with the number ``first``."""
        check_count("first", first, 0)
        decoder, _ = self._open_decoder()
        index = int(first)
        try:
            if decoder.skip(index) < index:
                return
            while (stored := self._read_next(decoder, index)) is not None:
                yield self._make_frame(index, stored)
                index += 1
        except DecoderStoppedError as error:
            self._end_early(f": frame {index} cannot be read: {error}.")
        finally:
            put_back(decoder)

    def __del__(self) -> None:
        with suppress(AttributeError):  # a film that could not be opened has no decoder
            self.close()

    def frame(self, index: int) -> VideoFrame:
        """Read one frame: the current one, or by its time, or from the start."""
        check_count("index", index, 0)
        with self._lock:
            return self._read_frame(int(index))

    def _read_frame(self, index: int) -> VideoFrame:
        if self._current is not None and self._current[1].index == index:
            return self._current[1]
        stored, decoder = self._find_frame(index)
        if stored is None:
            put_back(decoder)
            raise ParameterError.of("index", f"{index}", "the number of an existing frame")
        frame = self._make_frame(index, stored)
        self._current = decoder, frame
        return frame

    def close(self) -> None:
        """Close the file; it is opened again for the next requested frame."""
        if self._current is not None:
            put_back(self._current[0])
            self._current = None

    def _find_frame(self, index: int) -> tuple[StoredFrame | None, DecoderProcess]:
        """Find one frame: shortly after the current one, else by its time, else from the start."""
        current, self._current = self._current, None
        try:
            decoder = current[0] if current is not None else self._open_decoder()[0]
            position = 0 if current is None else current[1].index + 1
            if not 0 <= index - position < _MAX_DECODED_AHEAD:
                if decoder.seek(index):
                    frame = self._read_next(decoder, index)
                    known = self._times[index : index + 1]
                    # A file does not tell which frames cannot be decoded and so have no number.
                    if frame is None or not known or frame.time == known[0]:
                        return frame, decoder
                self._open(decoder)
                position = 0
            if decoder.skip(index - position) < index - position:
                return None, decoder
            return self._read_next(decoder, index), decoder
        except DecoderStoppedError as error:
            raise VideoError(f"Frame {index} of {self._name} cannot be read: {error}.") from None

    def _read_next(self, decoder: DecoderProcess, index: int) -> StoredFrame | None:
        """Read the next frame, which has this number; note its time, or why the film ends."""
        try:
            stored = decoder.read()
        except VideoError as error:
            self._end_early(f": frame {index} cannot be read: {error}")
            return None
        if stored is None:
            self._note_end(index, decoder.damaged)
            if self._problem is not None and decoder.is_full:
                self._end_early(f", after {inflect(index, 'frame')}: {NO_MEMORY}")
            return None
        if stored.pixels.shape != self._stored_shape:
            lines, columns = stored.pixels.shape[:2]
            self._end_early(
                f": frame {index} has {columns} x {lines} pixels, another size than the first."
            )
            return None
        time = stored.time - self._first_time
        if not abs(time) <= LATEST_TIME:
            self._end_early(
                f": the time of frame {index} is {time:.3g} s; "
                f"allowed: {-LATEST_TIME:g} to {LATEST_TIME:g} s."
            )
            return None
        if index == len(self._times):
            self._times.append(stored.time)
        return stored

    def _end_early(self, why: str) -> None:
        self._problem = f"{self._name} ends early{why}"

    def _note_end(self, frames: int, damaged: int) -> None:
        """Compare the film, if all of it was read, with what its file states."""
        stated, length = self.frame_count, self._facts.duration
        if frames > len(self._times):
            return
        if length is None and stated is not None and frames < stated:
            self._problem = (
                f"{self._name} contains {frames} of the {stated} frames that it states: it may be "
                "cut off or damaged."
            )
            return
        # A film whose first frame is shown late states its length from the time 0 on.
        times = np.array(self._times[:frames]) - min(self._first_time, 0.0)
        end = float(times[-1]) if frames else 0.0
        usual = 1.0 / self.frame_rate if self.frame_rate else 0.0
        longest = max(float(np.diff(times).max()) if frames > 1 else 0.0, usual)
        if length is not None and end + _MAX_END_STEPS * longest < length:
            self._problem = (
                f"{self._name} ends after {end:.3g} s of the {length:.3g} s that it states: it "
                "may be cut off or damaged."
            )
            return
        self.frame_count = frames
        if damaged:
            parts = inflect(damaged, "part")
            self._problem = f"{self._name} is damaged: {parts} cannot be decoded completely."

    def _read_first_frames(self, scan_axis: str) -> None:
        """Read the size, the first time and the scan axis from the first frames."""
        decoder, self._facts = self._open_decoder()
        facts = self._facts
        self.frame_rate, self.frame_count = facts.frame_rate, facts.frame_count
        self.times = FilmTimes(facts.resolution, facts.slowdown)
        try:
            first = decoder.read()
            if first is None:
                raise VideoError(
                    NO_MEMORY if decoder.is_full else "it contains no frame that can be decoded."
                )
            self._stored_shape = first.pixels.shape
            self._first_time = first.time
            self.turned = scan_axis == "lines" or (
                scan_axis == "auto" and self._are_stripes_lines(first, decoder)
            )
        except (VideoError, DecoderStoppedError) as error:
            raise self._refuse(decoder, error) from None
        if facts.field_axis is not None and bool(facts.field_axis) != self.turned:
            self.line_step = 2
        lines, columns = first.pixels.shape[:2]
        self.shape = (columns, lines) if self.turned else (lines, columns)
        put_back(decoder)

    def _read_note(self) -> None:
        """Read the scene and the recording of a simulated film from its file, if present."""
        note = read_note(self.path)
        with suppress(SceneFileError, ParameterError):
            self.scene = first_scene_in(note)
        if self.scene is not None:
            self.recording = Recording.from_text(note)

    def _are_stripes_lines(self, first: StoredFrame, decoder: DecoderProcess) -> bool:
        """Return whether the first frames' means of lines differ more than those of columns."""
        columns = lines = 0.0
        stored: StoredFrame | None = first
        for _ in range(_SCAN_AXIS_FRAMES):
            if stored is None or stored.pixels.shape != first.pixels.shape:
                break
            pixels = stored.pixels if stored.pixels.ndim == 2 else stored.pixels[..., 1].copy()
            columns += roughness_along(pixels, 0)
            lines += roughness_along(pixels, 1)
            try:
                stored = decoder.read()
            except (VideoError, DecoderStoppedError):
                break
        return lines > columns

    def _make_frame(self, index: int, stored: StoredFrame) -> VideoFrame:
        pixels = stored.pixels
        if self.turned:
            pixels = np.asarray(cv2.transpose(pixels), pixels.dtype)
        is_deep = pixels.dtype != np.uint8
        image = cv2.convertScaleAbs(pixels, alpha=_LEVEL_OF_16_BITS) if is_deep else pixels
        exposure = None
        if self.scene is not None and self.recording is not None:
            exposure = self.recording.exposure_time(self.scene, index)
        first_column = stored.first_line if self.line_step > 1 else 0.0
        time = stored.time - self._first_time
        return VideoFrame(
            index, time, np.asarray(image, np.uint8), exposure,
            first_column=first_column, samples=pixels if is_deep else None,
        )  # fmt: skip

    def _open_decoder(self) -> tuple[DecoderProcess, FilmFacts]:
        decoder = take_decoder()
        return decoder, self._open(decoder)

    def _open(self, decoder: DecoderProcess) -> FilmFacts:
        try:
            return decoder.open(self.path, self._container.reader, self._channel)
        except (VideoError, DecoderStoppedError) as error:
            raise self._refuse(decoder, error) from None

    def _refuse(self, decoder: DecoderProcess, error: Exception) -> VideoError:
        put_back(decoder)
        ending = str(error) if isinstance(error, VideoError) else f"{error}."
        return VideoError(f"{self._name} cannot be read: {ending}")
