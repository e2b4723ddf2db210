"""The main program of the decoder's process, which opens a film and sends requested frames.

FFmpeg takes as much memory and time as a file demands: a small damaged film can declare a huge
frame anywhere. Only a separate process can be limited and ended whatever a file contains, and its
messages on the standard streams do not mix with those of the program.
"""

import gc
import json
import os
import signal
import struct
import sys
import threading
import time
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import IO, Any

DECODER_OPTION = "--decoder-of-films"  # starts a bundled program as a decoder
MOST_MEMORY = 400_000_000  # bytes for decoding, beyond those in use at the process's start
LONGEST_REQUEST = 4.0  # maximum processor time of a request in seconds
TIMEOUT_CODE = 21  # exit code of a process that took too long

HEADER = struct.Struct("<II")  # precedes each answer: numbers of bytes of JSON and of pixels
NO_MEMORY = "decoding it takes more memory than is allowed."  # end of a sentence
_CHECK_SECONDS = 0.2  # seconds between checks of the processor time


_IDLE_SECONDS = 60.0  # seconds that a process without a film waits for the next one


class _Watch:
    """Ends the process if a request takes too much processor time, or if no more requests come."""

    def __init__(self) -> None:
        self._request_start: float | None = None
        self._close_time: float | None = None
        threading.Thread(target=self._watch, daemon=True).start()

    def begin(self) -> None:
        self._request_start, self._close_time = time.process_time(), None

    def end(self, has_film: bool) -> None:
        self._request_start, self._close_time = None, None if has_film else time.monotonic()

    def _watch(self) -> None:
        while True:
            time.sleep(_CHECK_SECONDS)
            request_start = self._request_start
            if request_start is not None and time.process_time() - request_start > LONGEST_REQUEST:
                os._exit(TIMEOUT_CODE)
            close_time = self._close_time
            if close_time is not None and time.monotonic() - close_time > _IDLE_SECONDS:
                os._exit(0)


def main() -> None:
    """Answer requests, one JSON object per line, until the end of standard input."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # Output of libraries must not mix with the answers.
    answers = os.fdopen(os.dup(1), "wb", buffering=0)
    with Path(os.devnull).open("r+b") as nowhere:
        os.dup2(nowhere.fileno(), 1)
        os.dup2(nowhere.fileno(), 2)
    from occ_model.video.file.pillow_source import PillowSource

    ffmpeg: Any = _refuse_without_pyav
    with suppress(ImportError):
        from occ_model.video.file.av_source import AvSource

        ffmpeg = AvSource
    _limit_memory()
    responder = _Responder(PillowSource, ffmpeg)
    watch = _Watch()
    with suppress(BrokenPipeError):
        # A bundled program without a console has no sys.stdin.
        for line in os.fdopen(0, "rb"):
            watch.begin()
            answer, pixels = responder.answer(json.loads(line))
            watch.end(responder.has_film)
            _send(answers, answer, pixels)
    # Skip the decoders' clean-up, which may wait for their threads.
    os._exit(0)


def _refuse_without_pyav(*_arguments: object) -> None:
    from occ_model.errors import VideoError

    raise VideoError("the package av, which reads films, cannot be imported: pip install av.")


class _Responder:
    """Answers requests about one film at a time."""

    def __init__(self, pillow: Any, ffmpeg: Any) -> None:
        self._pillow, self._ffmpeg = pillow, ffmpeg
        self._source: Any = None

    @property
    def has_film(self) -> bool:
        return self._source is not None

    def answer(self, request: dict[str, Any]) -> tuple[dict[str, Any], Any]:
        from occ_model.errors import VideoError

        try:
            return self._handle(request)
        except VideoError as error:
            return {"refused": str(error)}, None
        except Exception as error:  # noqa: BLE001 - decoders raise anything on damaged files
            if isinstance(error, MemoryError):
                return {"refused": NO_MEMORY}, None
            return {"refused": f"decoding it failed ({type(error).__name__})."}, None

    def _handle(self, request: dict[str, Any]) -> tuple[dict[str, Any], Any]:
        if request["do"] in ("open", "close") and self._source is not None:
            self._source.close()
            self._source = None
            gc.collect()  # PyAV's frames and their side data refer to each other
        if request["do"] == "close":
            return {}, None
        if request["do"] == "open":
            path, channel, reader = Path(request["path"]), request["channel"], request["reader"]
            self._source = (
                self._pillow(path, channel)
                if reader == "pillow"
                else self._ffmpeg(path, channel, reader)
            )
            return asdict(self._source.facts), None
        if request["do"] == "skip":
            skipped = 0
            while skipped < request["frames"] and self._source.skip():
                skipped += 1
            return {"skipped": skipped}, None
        if request["do"] == "seek":
            return {"next": self._source.seek(request["index"])}, None
        frame = self._source.read()
        if frame is None:
            is_full = _is_memory_full(self._source.pixels)
            return {"end": True, "full": is_full, "damaged": self._source.damaged}, None
        return {
            "time": frame.time,
            "shape": frame.pixels.shape,
            "type": frame.pixels.dtype.str,
            "first": frame.first_line,
        }, frame.pixels


def _send(answers: IO[bytes], answer: dict[str, Any], pixels: Any) -> None:
    import numpy as np

    text = json.dumps(answer).encode()
    content = b"" if pixels is None else np.ascontiguousarray(pixels).data.cast("B")
    _write(answers, HEADER.pack(len(text), len(content)) + text)
    _write(answers, content)


def _write(answers: IO[bytes], content: bytes | memoryview) -> None:
    view = memoryview(content)
    while view:
        view = view[answers.write(view) :]


def _limit_memory() -> None:
    """Limit this process's memory; Windows has no such limit, and macOS ignores it."""
    if sys.platform != "linux":
        return
    import resource

    with suppress(OSError, ValueError):
        limit = _count_data_bytes() + MOST_MEMORY
        resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))


def _count_data_bytes() -> int:
    """Return the bytes that count towards the limit, such as those reserved by threads."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmData:"):
            return int(line.split()[1]) * 1024
    return 0


def _is_memory_full(pixels: int) -> bool:
    from occ_model.video.file.source import check_memory

    try:
        check_memory(pixels)
    except MemoryError:
        return True
    return False
