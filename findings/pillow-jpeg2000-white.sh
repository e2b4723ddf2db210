#!/usr/bin/env bash
# Pillow has no colours of more than 8 bits, so that one would expect the upper 8 bits of a JPEG 2000 of
# 12 bits, or the nearest level of 8. It rounds to the nearest without a limit: the brightest 8 of the
# 4096 levels become level 256, of which 8 bits keep 0. What is white in the file is black in the picture,
# in the middle of the brightest area. A single channel is shifted up instead, so that white is 65520.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pillow==13.0.0 imagecodecs==2026.3.6 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import io
import sys

import imagecodecs
import numpy as np
from PIL import Image, __version__, features

print("Python", sys.version.split()[0], "Pillow", __version__, "OpenJPEG", features.version("jpg_2000"))

LEVELS = [0, 2048, 4080, 4087, 4088, 4095]  # of 12 bits


def read(pixels):
    """Return the levels that Pillow reads of a lossless JPEG 2000, which are checked first."""
    content = imagecodecs.jpeg2k_encode(pixels, level=0, bitspersample=12, codecformat="jp2", mct=False)
    assert (imagecodecs.jpeg2k_decode(content) == pixels).all()
    with Image.open(io.BytesIO(content)) as picture:
        return picture.mode, np.asarray(picture)[20].reshape(len(LEVELS), 16, -1)[:, 8, 0].tolist()


grey = np.tile(np.repeat(np.array(LEVELS, np.uint16), 16), (64, 1))
print("in the file:", LEVELS)
colour_mode, colours = read(np.dstack([grey] * 3))
print(f"as {colour_mode}:   {colours}, expected: [0, 128, 255, 255, 255, 255]")
grey_mode, levels = read(grey)
print(f"as {grey_mode}: {levels}, expected: white is 65535")
sys.exit(colours != [0, 128, 255, 255, 0, 0] or levels[-1] != 65520)
PYTHON
