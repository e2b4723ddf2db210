#!/usr/bin/env bash
# A pixel of an event camera that sees a blinking LED reports each edge. evlib prepares such recordings in one
# call, preprocess_events, which by default also removes noise by a refractory period of 1 ms. A pixel's
# refractory period is the time for which it reports nothing more after an event, so that one would expect one
# event a millisecond of a fast lamp. The filter counts from the last event that it met, also from those that
# it removes: of a lamp at 499 Hz it keeps every edge, and of one at 500 Hz or more a single event for each pixel,
# however long the recording is.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet evlib==0.13.2 polars==2.1.0 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - 2>&1 <<'PYTHON' | grep -v PyTorch
import sys
from importlib.metadata import version

import numpy as np
import polars as pl
from evlib.filtering import preprocess_events

print("Python", sys.version.split()[0], "evlib", version("evlib"), "Polars", pl.__version__)


def events_of_a_pixel(frequency, seconds=10):
    times = np.round(np.arange(0, seconds, 1 / (2 * frequency)) * 1e6).astype(np.int64)
    edges = np.arange(len(times))
    return pl.DataFrame(
        {
            "x": np.full(len(times), 100, np.int16),
            "y": np.full(len(times), 50, np.int16),
            "t": pl.Series(times).cast(pl.Duration("us")),
            "polarity": np.where(edges % 2, -1, 1).astype(np.int8),
        }
    ).lazy()


kept = {}
for frequency in (100, 499, 500, 2000):
    events = events_of_a_pixel(frequency)
    kept[frequency] = len(preprocess_events(events).collect())
    print(f"a lamp at {frequency} Hz for 10 s: {len(events.collect())} edges, {kept[frequency]} are kept")
print("expected of those at 500 and 2000 Hz: at least one event for every 1.5 ms, 6666")
assert kept == {100: 2000, 499: 9980, 500: 1, 2000: 1}
PYTHON
