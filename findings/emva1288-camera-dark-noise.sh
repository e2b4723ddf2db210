#!/usr/bin/env bash
# The package emva1288 belongs to the standard EMVA 1288, by which makers state a sensor's noise, and has a
# camera that simulates pictures by it. In the standard a dark picture has the mean of the black offset, and
# the variance K^2 s^2 + 1/12 of read noise of s electrons, gain K and rounding; the offset is there so
# that noise below 0 survives. One would expect both of the simulated camera. It cuts electrons off at 0
# before it adds the offset, which leaves half of the noise, and it adds the spread of rounding before it
# rounds, so that 1/12 counts twice.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet emva1288==1.0.2 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import importlib.metadata
import sys

from emva1288.camera import Camera

print("Python", sys.version.split()[0], "emva1288", importlib.metadata.version("emva1288"))


def dark_picture(read_noise, dark_signal, gain):
    camera = Camera(width=400, height=400, bit_depth=12, K=gain, u_esat=10_000.0, dark_current_ref=0.0,
                    dark_signal_0=dark_signal, sigma2_dark_0=read_noise**2, blackoffset=64, seed=1)
    return camera.grab(0).astype(float), camera.K, camera.blackoffset


picture, gain, offset = dark_picture(20.0, 0.0, 1.0)
print(f"read noise 20 e, K {gain:.2f}, offset {offset:.1f}:",
      f"mean {picture.mean():.2f}, expected {offset:.2f};",
      f"deviation {picture.std():.2f}, expected {gain * 20:.2f}")
assert picture.mean() - offset > 0.3 * gain * 20
assert picture.std() < 0.7 * gain * 20

picture, gain, offset = dark_picture(6.0, 100.0, 0.1)
variance = (gain * 6.0) ** 2
print(f"read noise 6 e, signal 100 e, K {gain:.3f}: variance {picture.var():.3f},",
      f"expected {variance + 1 / 12:.3f}")
assert abs(picture.var() - (variance + 2 / 12)) < 0.01
PYTHON
