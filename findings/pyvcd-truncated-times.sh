#!/usr/bin/env bash
# A blinking LED's waveform can be kept as a value change dump, which logic analysers and simulators read.
# pyvcd takes times as int or float. One would expect that a time between two ticks is refused, or goes to
# the nearer tick. It is cut off: a chip that ends at 17.9 us ends at 17, so edges come up to one tick early
# and chips of equal length are not equal in the file.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pyvcd==0.5.1
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import importlib.metadata
import io
import sys

from vcd import VCDWriter

print("Python", sys.version.split()[0], "pyvcd", importlib.metadata.version("pyvcd"))
file = io.StringIO()
with VCDWriter(file, timescale="1 us") as writer:
    led = writer.register_var("lamp", "led", "wire", size=1, init=0)
    for number, time in enumerate([8.9, 17.9, 26.9], 1):
        writer.change(led, time, number % 2)
    written = [int(line[1:]) for line in file.getvalue().splitlines() if line.startswith("#")]
print("asked:  [8.9, 17.9, 26.9], chips of 9 us after the first")
print("written:", written[1:], "expected: [9, 18, 27] or a refusal")
assert written[1:] == [8, 17, 26]
PYTHON
