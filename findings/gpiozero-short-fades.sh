#!/usr/bin/env bash
# A Raspberry Pi can dim an LED up and down by gpiozero's PWMLED: blink() takes the times on, off, of
# fading in and of fading out. One would expect that a period is their sum. A fade is made of 25 steps a second, and
# one that is shorter than 1/25 s has no step and takes no time, without a word: a period of 60 ms, 40 of
# them fading, takes 20 ms, and so the lamp blinks three times as fast as it was told. With pulse(), which
# only fades, nothing is left: the lamp changes as fast as the processor can.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet gpiozero==2.0.1.post3
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
import time
from importlib.metadata import version

from gpiozero import Device, PWMLED
from gpiozero.pins.mock import MockFactory, MockPWMPin

print("Python", sys.version.split()[0], "gpiozero", version("gpiozero"))
Device.pin_factory = MockFactory(pin_class=MockPWMPin)
lamp = PWMLED(5)


def seconds_of(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


fades = {"fade_in_time": 0.02, "fade_out_time": 0.02}
blinks = seconds_of(lambda: lamp.blink(on_time=0.05, off_time=0.05, **fades, n=10, background=False))
levels = {round(state.state, 3) for state in lamp.pin.states}
pulses = seconds_of(lambda: lamp.pulse(**fades, n=50, background=False))
slow = seconds_of(lambda: lamp.pulse(fade_in_time=0.2, fade_out_time=0.2, n=2, background=False))
print(f"ten periods of 50 + 50 + 20 + 20 ms: {'about 1.0' if blinks < 1.3 else blinks} s, expected 1.4 s")
print("levels of the lamp:", sorted(levels))
print(f"50 pulses of 20 + 20 ms: {'below 0.5' if pulses < 0.5 else pulses} s, expected 2 s")
print(f"two pulses of 200 + 200 ms: {'at least 0.8' if slow >= 0.8 else slow} s, expected 0.8 s")
assert 1.0 <= blinks < 1.3 and levels == {0, 1} and pulses < 0.5 and slow >= 0.79
PYTHON
