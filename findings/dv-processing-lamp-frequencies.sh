#!/usr/bin/env bash
# Several LEDs in the view of an event camera are told apart by their frequencies. dv-processing, of a maker of
# such cameras, has filters that keep or cut events by the "temporal frequency at a given pixel location", in Hz.
# One would expect that a band from 400 to 600 Hz keeps a lamp that blinks at 500 Hz. A filter takes the time from
# a pixel's last event, be it brighter or darker, for a period; a lamp has two edges a period, so the band
# keeps the lamp of 250 Hz and cuts the one of 500 Hz off. The numbers are those of the lamps only where events of
# one direction are left. So lamps at the mains, which flicker at 100 Hz, are cut at 200 Hz.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet dv-processing==2.0.4 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys

import dv_processing as dv
import numpy as np

print("Python", sys.version.split()[0], "dv-processing", dv.__version__)
SIZE, PERIODS = (64, 64), 500


def lamp(frequency, brighter_only=False):
    events = dv.EventStore()
    for edge in range(2 * PERIODS):
        brighter = edge % 2 == 0
        if brighter or not brighter_only:
            time = 1_000_000 + round(edge * 1e6 / (2 * frequency))
            events.push_back(time, 10, 10, brighter)
    return events


def share(keep, events):
    keep.accept(events)
    return round(len(keep.generateEvents()) / len(events), 2)


kept, single = {}, {}
for frequency in (100, 250, 500, 1000):
    kept[frequency] = share(dv.noise.BandPassFilter(SIZE, 400.0, 600.0), lamp(frequency))
    single[frequency] = share(dv.noise.BandPassFilter(SIZE, 400.0, 600.0), lamp(frequency, brighter_only=True))
    print(f"band from 400 to 600 Hz, lamp at {frequency} Hz: keeps {kept[frequency]:.0%} of its events", end="")
    print(f", {single[frequency]:.0%} where only the brighter ones are given")
mains = {
    cut: share(dv.noise.BandCutFilter(SIZE, cut - 20.0, cut + 20.0), lamp(100)) for cut in (100, 200)
}
print("share of a flicker at 100 Hz that is left when these frequencies are cut:", mains)
assert kept == {100: 0, 250: 1, 500: 0, 1000: 0} and single == {100: 0, 250: 0, 500: 1, 1000: 0}
assert mains == {100: 1, 200: 0}
PYTHON
