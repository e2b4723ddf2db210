#!/usr/bin/env bash
# Basler's pypylon contains an emulated camera, for programs that are tried without one. Makers' cameras have
# had their exposure time under three names: ExposureTimeAbs and ExposureTime in microseconds, and
# ExposureTimeRaw in units of ExposureTimeBaseAbs. One would expect that they are three views of one value,
# and that pictures come no faster than they are exposed. In the emulated camera they are three values: who
# sets one and reads another is told something else. None of them changes the stated frame rate, 100 a
# second with an exposure of 2 s, pictures arrive after some milliseconds, and each has the time stamp 0.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pypylon==26.9
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import os
import sys
import time

os.environ["PYLON_CAMEMU"] = "1"
from importlib.metadata import version

from pypylon import pylon

print("Python", sys.version.split()[0], "pypylon", version("pypylon"))
camera = pylon.InstantCamera(pylon.TlFactory.GetInstance().CreateFirstDevice())
camera.Open()
print("camera", camera.GetDeviceInfo().GetModelName(), "- base", camera.ExposureTimeBaseAbs.Value, "us")


def exposures():
    return camera.ExposureTimeAbs.Value, camera.ExposureTimeRaw.Value, camera.ExposureTime.Value


camera.ExposureTimeAbs.Value = 200
print("ExposureTimeAbs set to 200 us: Abs, Raw, Time =", exposures())
assert exposures() == (200, 10000, 10000)
camera.ExposureTimeRaw.Value = 300
print("ExposureTimeRaw set to 300:    Abs, Raw, Time =", exposures())
assert exposures() == (200, 300, 10000)
camera.ExposureTime.Value = 2e6
print("ExposureTime set to 2 s:       Abs, Raw, Time =", exposures())
assert exposures() == (200, 300, 2e6)
start = time.perf_counter()
picture = camera.GrabOne(5000)
elapsed = time.perf_counter() - start
print(f"frames a second {camera.ResultingFrameRateAbs.Value}, picture sooner than 2 s: {elapsed < 2},",
      f"time stamp {picture.TimeStamp}")
assert picture.GrabSucceeded() and elapsed < 2
assert camera.ResultingFrameRateAbs.Value == 100 and picture.TimeStamp == 0
camera.Close()
PYTHON
