#!/usr/bin/env bash
# Pyxel simulates detectors, and has two models of the converter from voltage to number: one in a single step,
# one by successive approximation. A detector states the range of voltages of its converter once, for both.
# One would expect the same numbers to within the last bit. With a range from 0 V they are. With one from 1 V
# to 3 V the single step spreads the numbers over the range; successive approximation ignores the lower end,
# so that the darkest voltage gets a third of the numbers, and only two thirds of the levels are left.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pyxel-sim==3.0.2
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
from pyxel.detectors import CMOS, Characteristics, CMOSGeometry, Environment
from pyxel.models.readout_electronics import sar_adc, simple_adc

print("Python", sys.version.split()[0], "Pyxel", version("pyxel-sim"), "NumPy", np.__version__)
voltages = np.array([[1.0, 1.5, 2.0, 2.5, 3.0]])


def numbers(convert, lowest, highest):
    characteristics = Characteristics(adc_bit_resolution=8, adc_voltage_range=(lowest, highest))
    detector = CMOS(CMOSGeometry(row=1, col=5), Environment(), characteristics)
    detector.signal.array = voltages.copy()
    convert(detector)
    return detector.image.array.astype(int)[0]


for lowest in (0.0, 1.0):
    single, successive = numbers(simple_adc, lowest, 3.0), numbers(sar_adc, lowest, 3.0)
    print(f"1 to 3 V, converter from {lowest} to 3 V: single step {single}, successive {successive}")
    if lowest == 0:
        assert np.abs(single - successive).max() <= 1
    else:
        assert single[0] == 0 and successive[0] == 85 and single[-1] == successive[-1] == 255
PYTHON
