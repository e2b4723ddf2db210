#!/usr/bin/env bash
# A wall in even light has the same value in all photosites of one colour, and demosaicing it should give
# that value everywhere. colour-demosaicing does so by the methods of Malvar and of Menon. Its bilinear
# method mirrors the mosaic at the rim including the outermost line, so that photosites of other colours
# take the places that it expects: the outermost rows and columns come out between a quarter of the light
# and 2.25 times of it. Rows are what a rolling shutter tells apart: the first and last ones are wrong.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet colour-demosaicing==0.2.7
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
import warnings
from importlib.metadata import version

warnings.simplefilter("ignore")  # of other packages that colour-science looks for
import colour_demosaicing
import numpy as np

print("Python", sys.version.split()[0], "colour-demosaicing", version("colour-demosaicing"))

even = np.full((12, 12), 100.0)
ranges = {}
for method in ("bilinear", "Malvar2004", "Menon2007"):
    picture = getattr(colour_demosaicing, f"demosaicing_CFA_Bayer_{method}")(even, "RGGB")
    inner = picture[1:-1, 1:-1]
    ranges[method] = picture.min(), picture.max()
    print(f"{method:10} inside {inner.min():.0f} to {inner.max():.0f},",
          f"with the rim {picture.min():.0f} to {picture.max():.0f}, expected 100")
    assert np.allclose(inner, 100)
assert np.allclose(ranges["Malvar2004"], 100) and np.allclose(ranges["Menon2007"], 100)
assert np.allclose(ranges["bilinear"], (25, 225))
PYTHON
