#!/usr/bin/env bash
# Stripes of a faint lamp are compared with a dark frame of the same exposure, and ccdproc, a package of
# astronomers, subtracts dark and bias frames from a camera's frames in the order of the book. Cameras
# write unsigned numbers of 16 bits to FITS files, and that is what it reads. One would expect that a dark pixel comes
# out near 0, on either side. The difference stays unsigned: a pixel that is 10 below its dark frame
# becomes 65526, brighter than the lamp. Only when the dark frame is scaled by the ratio of the
# exposures, though that ratio is 1, are the numbers right.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet ccdproc==2.5.1 astropy==8.0.2 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version

import astropy.units as u
import ccdproc
import numpy as np
from astropy.io import fits
from astropy.nddata import CCDData

print("Python", sys.version.split()[0], "ccdproc", version("ccdproc"), "Astropy", version("astropy"))


def frame_through_a_file(name, levels):
    header = fits.Header({"EXPTIME": 0.001})
    fits.PrimaryHDU(np.array(levels, np.uint16), header).writeto(name)
    return CCDData.read(name, unit="adu")


light = frame_through_a_file("light.fits", [[990, 1000, 1010, 3000]])
dark = frame_through_a_file("dark.fits", [[1000, 1000, 1000, 1000]])
exposure = {"exposure_time": "EXPTIME", "exposure_unit": u.s}
seen = {
    "dark frame": ccdproc.subtract_dark(light, dark, **exposure),
    "dark frame, scaled by 1": ccdproc.subtract_dark(light, dark, scale=True, **exposure),
    "bias frame": ccdproc.subtract_bias(light, dark),
}
for name, difference in seen.items():
    print(f"{name}: {difference.data.tolist()} expected: [[-10, 0, 10, 2000]]")
assert seen["dark frame"].data.tolist() == seen["bias frame"].data.tolist() == [[65526, 0, 10, 2000]]
assert seen["dark frame, scaled by 1"].data.tolist() == [[-10, 0, 10, 2000]]
PYTHON
