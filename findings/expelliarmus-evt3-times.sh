#!/usr/bin/env bash
# Event cameras, whose pixels report changes of light with a time in microseconds, read LEDs that blink too fast
# for frames. Their format EVT 3.0 has 24 bits of time: a word with the upper 12, EVT_TIME_HIGH, and one with
# the lower 12. One would expect that a lamp's frequency survives in expelliarmus. Its reader takes lower bits that fall
# for an overflow, although the upper ones have been stated meanwhile, so 4096 us count twice: a lamp
# of 500 Hz is read as one of 250 Hz. The reader evt3 gives the right times of the same file. Its writer
# states the upper bits once: a lamp at 50 Hz that it stores keeps of each half period its remainder by 4096 us.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet expelliarmus==1.1.12 evt3==0.4.1 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version

import evt3
import numpy as np
from expelliarmus import Wizard

print("Python", sys.version.split()[0], "expelliarmus", version("expelliarmus"), "evt3", version("evt3"))
Y, X, LOW, HIGH = 0x0000, 0x2000, 0x6000, 0x8000


def write_by_the_format(times):
    words, high = [], 0
    for number, time in enumerate(times):
        while high <= time >> 12:
            words.append(HIGH | high & 0xFFF)
            high += 1
        words += [LOW | time & 0xFFF, Y | 50, X | (number % 2) << 11 | 100]
    header = b"% evt 3.0\n% format EVT3;height=720;width=1280\n% geometry 1280x720\n% end\n"
    with open("lamp.raw", "wb") as file:
        file.write(header + np.array(words, "<u2").tobytes())


def stated_frequency(times):
    return 1e6 / (2 * np.mean(np.diff(np.asarray(times).astype(np.int64))))


write_by_the_format(range(1000, 10_000_000, 1000))
right = stated_frequency(evt3.decode_file("lamp.raw").timestamp)
read = stated_frequency(Wizard(encoding="evt3").read("lamp.raw")["t"])
print(f"a lamp at 500 Hz for 10 s: evt3 reads {right:.1f} Hz, expelliarmus {read:.1f} Hz")

events = np.zeros(1000, dtype=[("t", "<i8"), ("x", "<i2"), ("y", "<i2"), ("p", "u1")])
events["t"], events["p"] = np.arange(1000) * 10_000, np.arange(1000) % 2
Wizard(encoding="evt3").save("stored.raw", events)
back = np.diff(Wizard(encoding="evt3").read("stored.raw")["t"])
print("half periods of a lamp at 50 Hz: 10000 us, stored and read again:", np.unique(back), "us")
assert abs(right - 500) < 0.1 and abs(read - 250) < 0.2 and set(back.tolist()) == {10_000 % 4096}
PYTHON
