#!/usr/bin/env bash
# Cameras take 29.97 frames a second, and code that folds over frames needs that rate to a few parts in a
# million. OpenCV can write Motion JPEG in AVI by its own encoder or by FFmpeg's. One would expect the rate
# that was asked for from both: an AVI file holds it as a fraction. OpenCV's own encoder rounds it to a whole
# number, 0.1 % off, without a word; a film at 30.5 frames a second runs at 30.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet opencv-python-headless==5.0.0.93 av==18.1.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import av
import cv2
import numpy as np

print("Python", sys.version.split()[0], "OpenCV", cv2.__version__, "PyAV", av.__version__)


def rate_of(encoder, rate):
    film = cv2.VideoWriter("film.avi", encoder, cv2.VideoWriter.fourcc(*"MJPG"), rate, (64, 48))
    for level in range(0, 240, 8):
        film.write(np.full((48, 64, 3), level, np.uint8))
    film.release()
    with av.open("film.avi") as opened:
        return float(opened.streams.video[0].average_rate)


asked = [23.976, 29.97, 30.5, 59.94]
own = [rate_of(cv2.CAP_OPENCV_MJPEG, rate) for rate in asked]
ffmpeg = [rate_of(cv2.CAP_FFMPEG, rate) for rate in asked]
print("asked:        ", asked)
print("by FFmpeg:    ", ffmpeg)
print("by OpenCV own:", own, "expected:", asked)
assert ffmpeg == asked
assert own == [24.0, 30.0, 30.0, 60.0]
PYTHON
