#!/usr/bin/env bash
# An EULUMDAT file (.ldt) states a lamp's light in candela for each 1000 lm of the lamps' TOTAL flux (field
# 26c of the format), and the number of lamps beside it; makers of LED lamps, whose light is measured as
# a whole, write -1 for that number by an agreement of two makers of design programs, and the flux is that
# of the luminaire. One would expect that eulumdat-ies converts both to IES files of the same light. It
# multiplies the flux by the number of lamps: two lamps of 2000 lm together shine with 4000 lm. And
# for -1 it leaves the flux out: the LED lamp of 2000 lm shines with 1000 lm.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet eulumdat-ies==1.1.0 eulumdat-py==1.0.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
from eulumdat_ies import ldt_to_ies
from pyldt import Ldt, LdtHeader

print("Python", sys.version.split()[0], "eulumdat-ies", version("eulumdat-ies"))
angles = np.arange(0, 91, 1.0)


def flux_of_ies(lamps, total_flux):
    per_klm = 1000 / np.pi * np.cos(np.radians(angles))  # a Lambertian panel of 1000 lm
    header = LdtHeader(
        isym=1, mc=1, ng=len(angles), dg=1.0, lorl=100.0, dff=100.0, n_sets=1, num_lamps=[lamps],
        lamp_types=["LED"], lamp_flux=[total_flux], lamp_cct=["4000"], lamp_cri=["80"], lamp_watt=[20.0],
        c_angles=[0.0], g_angles=angles.tolist(),
    )
    text = ldt_to_ies(Ldt(header=header, intensities=[per_klm.tolist()]))
    numbers = text.split("TILT=NONE")[1].split()
    multiplier, candela = float(numbers[2]), np.array(numbers[-len(angles):], float)
    return np.trapezoid(multiplier * candela * 2 * np.pi * np.sin(np.radians(angles)), np.radians(angles))


for lamps, expected, seen in ((1, 2000, 2000), (2, 2000, 4000), (-1, 2000, 1000)):
    flux = flux_of_ies(lamps, 2000.0)
    print(f"{lamps:2} lamps, total flux 2000 lm: the IES file shines with {flux:.0f} lm, expected {expected}")
    assert abs(flux - seen) < 0.001 * seen
PYTHON
