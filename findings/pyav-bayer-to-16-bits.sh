#!/usr/bin/env bash
# A camera's mosaic of 8 bits is best turned into colours of more bits, so that means of neighbours keep their
# fractions, and light can be compared with that of deeper cameras. FFmpeg's formats of 16 bits are full where
# the light is: PyAV turns white, 255 of grey or of RGB, into 65535 or 65280. One would expect the same of a mosaic.
# In each of the four orders of its colours the numbers stay as they are: white is 255 of 65535, nearly
# black. The same mosaic to grey of 16 bits is white, and a mosaic of 16 bits comes out right.
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


def white_in(source, target):
    pixels = np.full((64, 64, 3) if source == "rgb24" else (64, 64), 255, np.uint8)
    if source.endswith("16le"):
        pixels = np.full((64, 64), 65535, np.uint16)
    levels = np.unique(av.VideoFrame.from_ndarray(pixels, format=source).reformat(format=target).to_ndarray())
    print(f"white of {source} in {target}: {levels.tolist()}")
    return levels.min()


assert white_in("gray", "rgb48le") >= 65280 and white_in("rgb24", "rgb48le") >= 65280
assert white_in("bayer_rggb8", "gray16le") == 65535 and white_in("bayer_rggb16le", "rgb48le") == 65535
for order in ("rggb", "bggr", "grbg", "gbrg"):
    assert white_in(f"bayer_{order}8", "rgb48le") == 255
PYTHON
