#!/usr/bin/env bash
# GalSim simulates a sensor's noise on images of any number type, and a raw picture is one of unsigned
# 16-bit numbers. One would expect that a noisy level is rounded as the converter's steps round it, and stays
# at 0 or more; or that integers are refused. Each level is cut off towards 0 instead, so that read noise and
# photons darken the picture by half a level in the mean, and on unsigned images noise below 0 comes out
# near 65535, white in place of black. On images of floats mean and deviation are those of the law.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet galsim==2.8.5 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import galsim

print("Python", sys.version.split()[0], "GalSim", galsim.__version__)


def noisy_levels(image_class):
    image = image_class(400, 400)
    image.fill(2)
    image.addNoise(galsim.CCDNoise(galsim.BaseDeviate(1), gain=4.0, read_noise=2.0))
    return image.array


floats, signed, unsigned = map(noisy_levels, (galsim.ImageF, galsim.ImageI, galsim.ImageUS))
print("floats:  ", "mean", round(floats.mean(), 3), "expected 2.000")
print("signed:  ", "mean", round(signed.mean(), 3), "expected 2.000, rounded")
print("unsigned:", "largest level", unsigned.max(), "expected about 6; near 65535:", (unsigned > 65000).sum())
assert abs(floats.mean() - 2.0) < 0.01
assert abs(signed.mean() - 1.5) < 0.02
assert unsigned.max() > 65000
PYTHON
