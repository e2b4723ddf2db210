#!/usr/bin/env bash
# Cameras of industry and raw films deliver a mosaic of colours, and PyAV converts it by FFmpeg to colours. A part
# of the conversion is done by each of several threads, by default one for each processor. One would expect
# that their number changes the time alone. Under light that rises evenly from line to line a bilinear method
# finds each line's light; the first and last two lines have no neighbours, and get that of the next one. With more
# threads so do the four lines around each thread's edge, amid the picture, and another computer puts
# them elsewhere: whoever reads a rolling shutter's lines should ask for one thread.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet av==18.1.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import av
import numpy as np

print("Python", sys.version.split()[0], "PyAV", av.__version__, "FFmpeg", av.ffmpeg_version_info)
lines = np.arange(480) * 100
mosaic = np.repeat(lines[:, np.newaxis], 640, axis=1).astype(np.uint16)
frame = av.VideoFrame.from_ndarray(mosaic, format="bayer_rggb16le")
rim = [0, 1, 478, 479]
expected = {1: rim, 2: [0, 1, 238, 239, 240, 241, 478, 479]}
expected[4] = sorted({*expected[2], 118, 119, 120, 121, 358, 359, 360, 361})
for threads, seen in expected.items():
    colours = frame.reformat(format="rgb48le", threads=threads).to_ndarray().astype(int)
    errors = np.abs(colours[:, 2:-2] - lines[:, np.newaxis, np.newaxis]).max(axis=(1, 2))
    wrong = np.flatnonzero(errors).tolist()
    print(f"{threads} threads: lines off by up to {errors.max()}, one line's step: {wrong}, expected {rim}")
    assert wrong == seen and errors.max() == 100
PYTHON
