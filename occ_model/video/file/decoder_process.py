"""Start the decoder's process, and request frames from it."""

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
from occ_model.video.file.decoder_main import DECODER_OPTION, HEADER, TIMEOUT_CODE
from occ_model.video.file.source import FilmFacts, StoredFrame

_PACKAGES = Path(__file__).resolve().parents[3]  # the folder that contains this package

START = "import sys; sys.path.insert(0, sys.argv[1]); " \
    "from occ_model.video.file.decoder_main import main; main()"  # fmt: skip

_FRAMES_A_REQUEST = 16  # frames skipped at a time

_ENVIRONMENT = {
    # Threads take memory, and FFmpeg decodes with its own threads.
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
}


class DecoderStoppedError(Exception):
    """The decoder's process has ended; the text is the reason as the end of a sentence."""


class DecoderProcess:
    """A process that decodes one film at a time, and always the next frame in advance.

    ``is_full``: whether the film ended without memory for more frames. ``damaged``: the number of
    its parts that could not be decoded, or not completely, if it was read from its start.
    """

    def __init__(self) -> None:
        self._process = process = subprocess.Popen(  # noqa: S603 - this program itself
            _command(),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **_ENVIRONMENT},
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self._has_advance_request = False
        self.is_full, self.damaged = False, 0
        self.end = weakref.finalize(self, _end, process)

    def open(self, path: Path, reader: str, channel: str) -> FilmFacts:
        """Open a film; return what it states. A VideoError is the end of a sentence."""
        self._discard_advance_answer()
        answer, _ = self._ask(
            {"do": "open", "path": str(path.resolve()), "reader": reader, "channel": channel}
        )
        return FilmFacts(**answer)

    def read(self) -> StoredFrame | None:
        """Return the next frame, None after the last, and request the one after it in advance.

        Raises VideoError, with the end of a sentence, if it cannot be decoded.
        """
        if not self._has_advance_request:
            self._send({"do": "read"})
        self._has_advance_request = False
        answer, pixels = self._receive()
        frame = _parse_frame(answer, pixels)
        self.is_full, self.damaged = bool(answer.get("full")), int(answer.get("damaged", 0))
        if frame is not None:
            self._send({"do": "read"})
            self._has_advance_request = True
        return frame

    def skip(self, frames: int) -> int:
        """Skip some frames; return the number skipped. Raises as for :meth:`read`."""
        skipped = 0
        if frames > 0 and self._has_advance_request:
            self._has_advance_request = False
            if _parse_frame(*self._receive()) is None:
                return 0
            skipped = 1
        while skipped < frames:
            # Each request is short, so that a long film is not mistaken for one that hangs.
            requested = min(frames - skipped, _FRAMES_A_REQUEST)
            answer, _ = self._ask({"do": "skip", "frames": requested})
            skipped += answer["skipped"]
            if answer["skipped"] < requested:
                break
        return skipped

    def seek(self, index: int) -> bool:
        """Go to the frame with a number; return False if it cannot be found."""
        self._discard_advance_answer()
        found: int | None = self._ask({"do": "seek", "index": index})[0]["next"]
        return found is not None and self.skip(index - found) == index - found

    def close_film(self) -> None:
        """Close the open film and free its memory."""
        self._discard_advance_answer()
        self._ask({"do": "close"})

    @property
    def is_alive(self) -> bool:
        return self.end.alive and self._process.poll() is None

    def _discard_advance_answer(self) -> None:
        """Discard the answer that was requested in advance."""
        if self._has_advance_request:
            self._has_advance_request = False
            self._receive(raises=False)

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
            raise self._explain_end() from None

    def _receive(self, raises: bool = True) -> tuple[dict[str, Any], bytearray]:
        size, content = HEADER.unpack(self._read_bytes(HEADER.size))
        answer: dict[str, Any] = json.loads(bytes(self._read_bytes(size)))
        pixels = self._read_bytes(content)
        if raises and "refused" in answer:
            raise VideoError(answer["refused"])
        return answer, pixels

    def _read_bytes(self, count: int) -> bytearray:
        stream = self._process.stdout
        if stream is None or stream.closed:
            raise DecoderStoppedError("the decoder was closed")
        content = bytearray(count)
        view, position = memoryview(content), 0
        while position < count:
            count_read = stream.readinto(view[position:])  # type: ignore[attr-defined]
            if not count_read:
                raise self._explain_end()
            position += count_read
        return content

    def _explain_end(self) -> DecoderStoppedError:
        code = self._process.wait()
        self.end()
        if code == TIMEOUT_CODE:
            return DecoderStoppedError("decoding it takes too long")
        return DecoderStoppedError("the decoder failed")


def _command() -> list[str]:
    if getattr(sys, "frozen", False):  # a bundle has no Python executable
        return [sys.executable, DECODER_OPTION]
    return [sys.executable, "-P", "-c", START, str(_PACKAGES)]


spare: list[DecoderProcess] = []
_spare_lock = threading.Lock()


def take_decoder() -> DecoderProcess:
    """Return the spare process, or start one, which takes a third of a second."""
    with _spare_lock:
        decoder = spare.pop() if spare else None
    if decoder is not None and decoder.is_alive:
        with suppress(DecoderStoppedError):  # it may just have ended after its idle time
            decoder.close_film()
            return decoder
    return DecoderProcess()


def put_back(decoder: DecoderProcess) -> None:
    """Keep one spare process for the next film, which ends itself when idle; end any others."""
    try:
        decoder.close_film()
    except DecoderStoppedError:
        return
    with _spare_lock:
        if not spare:
            spare.append(decoder)
            return
    decoder.end()


def _parse_frame(answer: dict[str, Any], pixels: bytearray) -> StoredFrame | None:
    if "time" not in answer:
        return None
    image = np.frombuffer(pixels, answer["type"]).reshape(answer["shape"])
    return StoredFrame(float(answer["time"]), image, float(answer["first"]))


def _end(process: "subprocess.Popen[bytes]") -> None:
    process.kill()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            with suppress(OSError):  # about unwritten data
                stream.close()
    process.wait()
