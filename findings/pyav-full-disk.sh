#!/usr/bin/env bash
# A film that is written may find the disk full. Given a path, PyAV raises an error that is an OSError with
# its number. Given a file that Python has opened, the OSError comes from that file's own write(), and one
# would expect it, or again an OSError. It is av.error.PyAVCallbackError, which is none: a program with
# "except OSError" passes for one that minds full disks, until it is given a file. The full disk is played
# here by a limit on the size of files.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet av==18.1.0 numpy==2.3.5
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import resource
import signal
import sys

import av
import numpy as np

print("Python", sys.version.split()[0], "PyAV", av.__version__, "FFmpeg", av.ffmpeg_version_info)
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, resource.RLIM_INFINITY))
noise = np.random.default_rng(1)


def write(target):
    with av.open(target, "w", format="mp4") as film:
        stream = film.add_stream("ffv1", 30)
        stream.width, stream.height, stream.pix_fmt = 256, 192, "gray"
        for number in range(20):
            frame = av.VideoFrame.from_ndarray(noise.integers(0, 256, (192, 256), np.uint8), "gray")
            frame.pts = number
            film.mux(stream.encode(frame))
        film.mux(stream.encode(None))


def error_of(target):
    try:
        write(target)
    except Exception as error:
        name, is_of_system = type(error).__name__, isinstance(error, OSError)
        print(f"{type(target).__name__}: {name}, an OSError: {is_of_system}; expected: True")
        return name, is_of_system
    return None


by_path = error_of("path.mp4")
with open("file.mp4", "wb", buffering=0) as file:
    by_file = error_of(file)
sys.exit(by_path is None or not by_path[1] or by_file != ("PyAVCallbackError", False))
PYTHON
