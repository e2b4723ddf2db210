#!/usr/bin/env bash
# A lamp's frame often begins with an m-sequence, the longest one that a shift register of m bits makes: each of its
# shifts differs from it in half of its chips, so that its correlation, 2^m - 1 where it fits, is -1 elsewhere.
# The function m_seq of scikit-dsp-comm is documented to give one for m from 2 to 12 and for 16. One would
# expect the same of all of them. That of m = 16 is none: its polynomial is not primitive, it has 32793 ones
# in place of 32768, and its correlation with its own shifts reaches -2077 and 2079.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet scikit-dsp-comm==2.1.2 scipy==1.17.1 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
from scipy.signal import max_len_seq
from sk_dsp_comm.sigsys import m_seq

print("Python", sys.version.split()[0], "scikit-dsp-comm", version("scikit-dsp-comm"))


def side_lobes(chips):
    signs = 2.0 * np.asarray(chips) - 1
    correlation = np.fft.ifft(np.abs(np.fft.fft(signs)) ** 2).real
    return sorted({int(round(value)) for value in correlation[1:]})


for bits in [*range(2, 13), 16]:
    chips = m_seq(bits)
    lobes = side_lobes(chips)
    assert len(chips) == 2**bits - 1
    if bits < 16:
        assert lobes == [-1] and sum(chips) == 2 ** (bits - 1)
print("m = 2 to 12: every correlation with a shift is -1, as expected")
print(f"m = 16: {int(sum(chips))} ones, correlations from {lobes[0]} to {lobes[-1]}, expected 32768 ones and -1")
assert (int(sum(chips)), lobes[0], lobes[-1]) == (32793, -2077, 2079)
scipy_lobes = side_lobes(max_len_seq(16)[0])
print("m = 16 of SciPy:", scipy_lobes)
assert scipy_lobes == [-1]
PYTHON
