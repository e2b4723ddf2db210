#!/usr/bin/env bash
# A DNG may note the black level of each line of the sensor: BlackLevelDeltaV adds a number for every
# line to BlackLevel, and BlackLevelRepeatDim repeats several levels down the lines. One would expect
# that the photosites are flat under flat light once rawpy's black levels are taken off. But rawpy has
# one level for each colour: of the repeated ones it gives the first, and LibRaw has replaced those of
# the lines by their mean. What is left are stripes along the axis that a rolling shutter scans, which
# the light did not make.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet rawpy==0.28.0 tifffile==2026.3.3 numpy==2.3.5
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import numpy as np
import rawpy
import tifffile

print("Python", sys.version.split()[0], "rawpy", rawpy.__version__, "LibRaw", rawpy.libraw_version)

LINES, COLUMNS, BLACK, LIGHT = 96, 128, 512, 4000


def left_of(name, black_of_lines, *tags):
    """Return the black levels that rawpy gives, and how much lines of flat light then differ."""
    light = np.full((LINES, COLUMNS), LIGHT) + black_of_lines[:, None]
    every = [
        (50706, 1, 4, b"\1\4\0\0", True),  # DNG 1.4
        (50708, 2, 0, "Camera", True),
        (33421, 3, 2, (2, 2), True),
        (33422, 1, 4, b"\0\1\1\2", True),  # red, green; green, blue
        (50717, 3, 1, 65535, True),
    ]
    tifffile.imwrite(name, light.astype(np.uint16), photometric=32803, extratags=[*every, *tags])
    with rawpy.imread(name) as raw:
        levels = raw.black_level_per_channel
        photosites = raw.raw_image_visible.astype(float)
        colours = raw.raw_colors_visible
    lines = (photosites - np.array(levels)[colours]).mean(axis=1)
    print(f"{name}: black levels {levels}; lines differ by {np.ptp(lines):g}, expected: 0")
    return levels, float(np.ptp(lines))


added = np.arange(LINES) * 2
numbers = tuple(part for level in added.tolist() for part in (level, 1))
by_line = left_of(
    "delta.dng", BLACK + added, (50714, 3, 1, BLACK, True), (50716, 10, LINES, numbers, True)
)
four = (BLACK, BLACK + 20, BLACK + 40, BLACK + 60)
repeated = left_of(
    "repeated.dng", np.resize(four, LINES), (50713, 3, 2, (4, 1), True), (50714, 3, 4, four, True)
)
mean = BLACK + int(added.mean())
sys.exit(by_line != ([mean] * 4, 190.0) or repeated != ([BLACK] * 4, 60.0))
PYTHON
