#!/usr/bin/env bash
# Which photosites of a raw picture are red differs from camera to camera, and colours of LEDs carry data where
# colour shift keying is used. The package demosaic takes the mosaic's pattern by OpenCV's names, and has methods
# of its own beside OpenCV's. One would expect that a method finds red where the pattern says that it is.
# OpenCV's does. The own ones take RGGB for BGGR and GBRG for GRBG: whichever of the two is asked for,
# the picture is the same, and for one of them red and blue are exchanged. They also lose lines: the
# default method makes 28 by 28 pixels of 32 by 32. And it makes white of any grey of floats from 0 to 1, which
# the description allows.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet demosaic==1.1.3 opencv-python==5.0.0.93 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version

import cv2
import numpy as np
from demosaic import bayer, colour

print("Python", sys.version.split()[0], "demosaic", version("demosaic"), "OpenCV", cv2.__version__)


def pattern_that_is_used(method, code):
    letters = ""
    for line, column in ((0, 0), (0, 1), (1, 0), (1, 1)):
        mosaic = np.zeros((32, 32), np.uint8)
        mosaic[line::2, column::2] = 200
        picture = bayer.demosaic(mosaic, method=method, colour=code, blur_kernel=0)
        letters += "RGB"[int(np.argmax(picture[8:20, 8:20].mean(axis=(0, 1))))]
    return letters


used = {}
for pattern in ("RGGB", "BGGR", "GRBG", "GBRG"):
    code = getattr(colour, f"{pattern}2RGB")
    used[pattern] = {name: pattern_that_is_used(name, code) for name in ("none", "bilinear", "malvar", "cv")}
    print(f"asked for {pattern}, used:", used[pattern])
grey = bayer.demosaic(np.full((32, 32), 0.7), colour=colour.BGGR2RGB)
print("grey of 0.7 by the default method:", np.unique(grey), "shape", grey.shape, "expected 0.7 and (32, 32, 3)")
for own in ("none", "bilinear", "malvar"):
    assert [used[pattern][own] for pattern in used] == ["BGGR", "BGGR", "GRBG", "GRBG"]
assert all(used[pattern]["cv"] == pattern for pattern in used)
assert np.unique(grey).tolist() == [1.0] and grey.shape == (28, 28, 3)
PYTHON
