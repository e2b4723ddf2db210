"""Start the decoder's own process, and ask it for frames."""

import json
import os
import subprocess
import sys
import threading
import weakref
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from occ_model.errors import VideoError
from occ_model.video.file.decoder_main import DECODER_OPTION, HEADER, TOOK_TOO_LONG
from occ_model.video.file.source import StoredFrame

_PACKAGES = Path(__file__).resolve().parents[3]  # the folder that holds this package

START = "import sys; sys.path.insert(0, sys.argv[1]); " \
    "from occ_model.video.file.decoder_main import main; main()"  # fmt: skip

_ENVIRONMENT = {
    "OPENCV_FFMPEG_LOGLEVEL": "-8",
    "OPENCV_LOG_LEVEL": "SILENT",
    # Threads take memory, and a film is decoded by FFmpeg's own.
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
}


OpenedFilm = tuple[float | None, int | None]
"""Frame rate and number of frames as a film states them, None where it does not."""


class DecoderStoppedError(Exception):
    """The decoder's process has ended; the text is the reason, as the end of a sentence."""


class DecoderProcess:
    """A process that decodes films, one at a time, and the next frame ahead.

    ``is_full``: whether the film ended, and no more frames would have fitted into the memory.
    """

    def __init__(self) -> None:
        self._process = process = subprocess.Popen(  # noqa: S603 - this very program
            _command(),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **_ENVIRONMENT},
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self._ahead = False
        self.is_full = False
        self.end = weakref.finalize(self, _end, process)

    def open(self, path: Path, reader: str, channel: str) -> OpenedFilm:
        """Open a film; return its frame rate and count. Raises VideoError with a sentence's end."""
        self._forget()
        answer, _ = self._ask(
            {"do": "open", "path": str(path.resolve()), "reader": reader, "channel": channel}
        )
        return answer["rate"], answer["count"]

    def read(self) -> StoredFrame | None:
        """Return the next frame, None after the last; the one after it is requested ahead.

        Raises VideoError: it cannot be decoded: the end of a sentence.
        """
        if not self._ahead:
            self._send({"do": "read"})
        self._ahead = False
        answer, pixels = self._receive()
        frame = _frame(answer, pixels)
        self.is_full = bool(answer.get("full"))
        if frame is not None:
            self._send({"do": "read"})
            self._ahead = True
        return frame

    def skip(self, frames: int) -> int:
        """Skip some frames; return how many there were. Raises as :meth:`read` does."""
        passed = 0
        if frames > 0 and self._ahead:
            self._ahead = False
            if _frame(*self._receive()) is None:
                return 0
            passed = 1
        while passed < frames:
            # Each request is short, so that a long film does not look like one that hangs.
            asked = min(frames - passed, _AT_ONCE)
            answer, _ = self._ask({"do": "skip", "frames": asked})
            passed += answer["passed"]
            if answer["passed"] < asked:
                break
        return passed

    def seek(self, index: int, time: float, within: float) -> StoredFrame | None:
        """Return a frame by its number, within some seconds of a time; None where not found."""
        self._forget()
        return _frame(*self._ask({"do": "seek", "index": index, "time": time, "within": within}))

    def close_film(self) -> None:
        """Close the film that is open, whose memory is freed."""
        self._forget()
        self._ask({"do": "close"})

    @property
    def is_alive(self) -> bool:
        return self.end.alive and self._process.poll() is None

    def _forget(self) -> None:
        """Discard the answer that was requested ahead."""
        if self._ahead:
            self._ahead = False
            self._receive(refuses=False)

    def _ask(self, request: dict[str, Any]) -> tuple[dict[str, Any], bytearray]:
        self._send(request)
        return self._receive()

    def _send(self, request: dict[str, Any]) -> None:
        stream = self._process.stdin
        if stream is None or stream.closed:
            raise DecoderStoppedError("the decoder was closed")
        try:
            stream.write(json.dumps(request).encode() + b"\n")
            stream.flush()
        except OSError:
            raise self._stopped() from None

    def _receive(self, refuses: bool = True) -> tuple[dict[str, Any], bytearray]:
        size, content = HEADER.unpack(self._bytes(HEADER.size))
        answer: dict[str, Any] = json.loads(bytes(self._bytes(size)))
        pixels = self._bytes(content)
        if refuses and "refused" in answer:
            raise VideoError(answer["refused"])
        return answer, pixels

    def _bytes(self, count: int) -> bytearray:
        stream = self._process.stdout
        if stream is None or stream.closed:
            raise DecoderStoppedError("the decoder was closed")
        content = bytearray(count)
        view, place = memoryview(content), 0
        while place < count:
            got = stream.readinto(view[place:])  # type: ignore[attr-defined]
            if not got:
                raise self._stopped()
            place += got
        return content

    def _stopped(self) -> DecoderStoppedError:
        code = self._process.wait()
        self.end()
        if code == TOOK_TOO_LONG:
            return DecoderStoppedError("decoding it takes too long")
        return DecoderStoppedError("the decoder failed")


_AT_ONCE = 16


def _command() -> list[str]:
    if getattr(sys, "frozen", False):  # a bundle, whose programs are no Python
        return [sys.executable, DECODER_OPTION]
    return [sys.executable, "-P", "-c", START, str(_PACKAGES)]


spare: list[DecoderProcess] = []
_spare_lock = threading.Lock()


def take_decoder() -> DecoderProcess:
    """Take the process that was put back last, or start one: that takes a third of a second."""
    with _spare_lock:
        decoder = spare.pop() if spare else None
    if decoder is not None and decoder.is_alive:
        with suppress(DecoderStoppedError):  # it waited so long that it has ended just now
            decoder.close_film()
            return decoder
    return DecoderProcess()


def put_back(decoder: DecoderProcess) -> None:
    """Keep one process for the next film, which ends by itself after a while; end others."""
    try:
        decoder.close_film()
    except DecoderStoppedError:
        return
    with _spare_lock:
        if not spare:
            spare.append(decoder)
            return
    decoder.end()


def _frame(answer: dict[str, Any], pixels: bytearray) -> StoredFrame | None:
    if "time" not in answer:
        return None
    shaped = np.frombuffer(pixels, np.uint8).reshape(answer["shape"])
    return StoredFrame(float(answer["time"]), shaped)


def _end(process: "subprocess.Popen[bytes]") -> None:
    process.kill()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            with suppress(OSError):  # about what was not yet written
                stream.close()
    process.wait()
