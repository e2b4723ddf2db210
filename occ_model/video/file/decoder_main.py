"""The decoder's own process: opens a film and sends the requested frames.

FFmpeg takes what memory and time a file makes it take: a small damaged film can declare a huge
frame anywhere. Only a process of its own can be limited and ended, whatever is in a file; and its
messages on the standard streams are nobody else's.
"""

import json
import os
import signal
import struct
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

DECODER_OPTION = "--decoder-of-films"  # makes a bundled program a decoder
MOST_MEMORY = 400_000_000  # bytes that decoding may take, beyond those at the process's start
_BYTES_A_PIXEL_LEFT = 12  # of memory for a decoder to go on: four frames in colours
LONGEST_REQUEST = 4.0  # seconds of processor time that one request may take
TOOK_TOO_LONG = 21  # exit code of a process that took too long

HEADER = struct.Struct("<II")  # before each answer: the bytes of its JSON and of its pixels
NO_MEMORY = "decoding it takes more memory than is allowed."  # end of a sentence
_NO_MEMORY_LEFT = -4  # OpenCV's code of an error where memory lacks: ``cv2.Error.StsNoMem``
_CHECK_SECONDS = 0.2  # seconds between looks at the processor time


_IDLE_SECONDS = 60.0  # seconds that a process without a film waits for the next one


class _Watch:
    """Ends the process when a request takes too much processor time, or none comes any more."""

    def __init__(self) -> None:
        self._since: float | None = None
        self._closed: float | None = None
        threading.Thread(target=self._look, daemon=True).start()

    def begin(self) -> None:
        self._since, self._closed = time.process_time(), None

    def end(self, has_film: bool) -> None:
        self._since, self._closed = None, None if has_film else time.monotonic()

    def _look(self) -> None:
        while True:
            time.sleep(_CHECK_SECONDS)
            since = self._since
            if since is not None and time.process_time() - since > LONGEST_REQUEST:
                os._exit(TOOK_TOO_LONG)
            closed = self._closed
            if closed is not None and time.monotonic() - closed > _IDLE_SECONDS:
                os._exit(0)


def main() -> None:
    """Answer requests, one JSON object a line, until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # Nothing that a library prints may come among the answers.
    answers = os.fdopen(os.dup(1), "wb", buffering=0)
    with Path(os.devnull).open("r+b") as nowhere:
        os.dup2(nowhere.fileno(), 1)
        os.dup2(nowhere.fileno(), 2)
    from occ_model.video.file.source import FrameSource, OpenCvSource, PillowSource

    _limit_memory()
    kinds: dict[str, type[FrameSource]] = {"opencv": OpenCvSource, "pillow": PillowSource}
    answering = _Answering(kinds)
    watch = _Watch()
    with suppress(BrokenPipeError):
        # A bundled program without a console has no sys.stdin.
        for line in os.fdopen(0, "rb"):
            watch.begin()
            answer, pixels = answering.answer(json.loads(line))
            watch.end(answering.has_film)
            _send(answers, answer, pixels)
    # The decoders' own clean-up may wait for their threads.
    os._exit(0)


class _Answering:
    """Answers requests about one film at a time."""

    def __init__(self, kinds: dict[str, Any]) -> None:
        self._kinds = kinds
        self._source: Any = None

    @property
    def has_film(self) -> bool:
        return self._source is not None

    def answer(self, request: dict[str, Any]) -> tuple[dict[str, Any], Any]:
        from occ_model.errors import VideoError

        try:
            return self._answered(request)
        except VideoError as error:
            return {"refused": str(error)}, None
        except Exception as error:  # noqa: BLE001 - decoders raise anything on damaged files
            if isinstance(error, MemoryError) or getattr(error, "code", 0) == _NO_MEMORY_LEFT:
                return {"refused": NO_MEMORY}, None
            return {"refused": f"decoding it failed ({type(error).__name__})."}, None

    def _answered(self, request: dict[str, Any]) -> tuple[dict[str, Any], Any]:
        if request["do"] in ("open", "close") and self._source is not None:
            self._source.close()
            self._source = None
        if request["do"] == "close":
            return {}, None
        if request["do"] == "open":
            kind = self._kinds[request["reader"]]
            self._source = source = kind(Path(request["path"]), request["channel"])
            return {"rate": source.frame_rate, "count": source.frame_count}, None
        if request["do"] == "skip":
            passed = 0
            while passed < request["frames"] and self._source.skip():
                passed += 1
            return {"passed": passed}, None
        if request["do"] == "seek":
            frame = self._source.seek(request["index"], request["time"], request["within"])
        else:
            frame = self._source.read()
        if frame is None:
            return {"end": True, "full": _is_memory_full(self._source)}, None
        return {"time": frame.time, "shape": frame.pixels.shape}, frame.pixels


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
    """Limit this process's memory; Windows has no such limit, and macOS does not hold to it."""
    if sys.platform != "linux":
        return
    import resource

    with suppress(OSError, ValueError):
        most = _data_of_this_process() + MOST_MEMORY
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))


def _data_of_this_process() -> int:
    """Return the bytes that count for the limit: more than are in use, of threads for example."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmData:"):
            return int(line.split()[1]) * 1024
    return 0


def _is_memory_full(source: Any) -> bool:
    """Return whether a few more frames exceed the memory: FFmpeg gives no reason."""
    import numpy as np

    try:
        np.empty(_BYTES_A_PIXEL_LEFT * source.pixels, np.uint8)
    except MemoryError:
        return True
    return False
