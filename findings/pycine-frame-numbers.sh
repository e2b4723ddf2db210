#!/usr/bin/env bash
# High-speed cameras by Phantom are what a lamp's edges are checked with. Their files number the frames from the
# trigger on: 0 is the frame of the trigger, and frames before it have negative numbers. pycine takes such a
# number, "the frame number in Phantom Camera Control", as start_frame_cine. One would expect the frame of
# that number. Each comes one too early: for the first one, the last of the film is delivered, then the
# first. And for 0 it is the first frame of the film, how far before the trigger it may lie.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pycine==0.3.2 numpy==2.4.6 opencv-python==5.0.0.93
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import ctypes
import sys
from importlib.metadata import version

import numpy as np
from pycine.cine import BITMAPINFOHEADER, CINEFILEHEADER, SETUP
from pycine.raw import read_frames

print("Python", sys.version.split()[0], "pycine", version("pycine"))
WIDTH, HEIGHT, NUMBERS = 64, 32, range(-3, 5)
file_header, picture_header, setup = CINEFILEHEADER(), BITMAPINFOHEADER(), SETUP()
file_header.Type = int.from_bytes(b"CI", "little")
file_header.Headersize, file_header.Version = ctypes.sizeof(file_header), 1
file_header.FirstMovieImage = file_header.FirstImageNo = NUMBERS[0]
file_header.TotalImageCount = file_header.ImageCount = len(NUMBERS)
file_header.OffImageHeader = ctypes.sizeof(file_header)
file_header.OffSetup = file_header.OffImageHeader + ctypes.sizeof(picture_header)
file_header.OffImageOffsets = file_header.OffSetup + ctypes.sizeof(setup)
picture_header.biSize = ctypes.sizeof(picture_header)
picture_header.biWidth, picture_header.biHeight = WIDTH, HEIGHT
picture_header.biPlanes, picture_header.biBitCount = 1, 16
picture_header.biSizeImage = WIDTH * HEIGHT * 2
setup.Mark, setup.Length = int.from_bytes(b"ST", "little"), ctypes.sizeof(setup)
setup.RealBPP, setup.BlackLevel, setup.WhiteLevel = 12, 0, 4095
start, step = file_header.OffImageOffsets + 8 * len(NUMBERS), 8 + picture_header.biSizeImage
with open("lamp.cine", "wb") as file:
    for part in (file_header, picture_header, setup):
        file.write(part)
    file.write((start + step * np.arange(len(NUMBERS))).astype("<i8").tobytes())
    for number in NUMBERS:  # each frame is as bright as its number says
        file.write(np.array([8, picture_header.biSizeImage], "<u4").tobytes())
        file.write(np.full((HEIGHT, WIDTH), 1000 + 100 * number, "<u2").tobytes())


def frames(count, **start):
    pictures, _, _ = read_frames("lamp.cine", count=count, **start)
    return [(int(picture[0, 0]) - 1000) // 100 for picture in pictures]


print("all frames:", frames(len(NUMBERS)))
asked = {number: frames(1, start_frame_cine=number)[0] for number in NUMBERS}
print("asked for and delivered:", asked)
print("four frames from -3 on:", frames(4, start_frame_cine=-3), "expected: [-3, -2, -1, 0]")
assert frames(len(NUMBERS)) == list(NUMBERS)
assert asked == {-3: 4, -2: -3, -1: -2, 0: -3, 1: 0, 2: 1, 3: 2, 4: 3}
PYTHON
