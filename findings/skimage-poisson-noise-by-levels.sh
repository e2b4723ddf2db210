#!/usr/bin/env bash
# Pictures of a simulation are often made noisy by scikit-image's random_noise with mode "poisson", for the
# noise of photons. One would expect that a pixel's noise follows from its own light: a deviation that is
# proportional to the root of its value. The function takes the number of different values in the whole
# picture, rounded up to a power of two, for the number of photons of white. So the same grey is ten times
# noisier in a picture of two levels, as a noise-free picture of stripes is, than in one with a gradient,
# and one pixel of another value can change the noise of all others.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet scikit-image==0.26.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import numpy as np
import skimage
from skimage.util import random_noise

print("Python", sys.version.split()[0], "scikit-image", skimage.__version__, "NumPy", np.__version__)

deviations = {}
for levels in (2, 15, 16, 256):
    picture = np.full((400, 400), 0.5)
    picture[0, :levels] = np.linspace(0, 1, levels)
    deviations[levels] = random_noise(picture, mode="poisson", clip=False, rng=1)[1:].std()
    photons = 0.5 / deviations[levels] ** 2
    print(f"{levels:3} levels in the first row: grey 0.5 elsewhere has deviation {deviations[levels]:.4f},")
    print(f"    that of {photons:.0f} photons of white")
assert abs(deviations[256] - np.sqrt(0.5 / 512)) < 0.001
assert deviations[2] > 10 * deviations[256]
assert deviations[15] > 1.3 * deviations[16]
PYTHON
