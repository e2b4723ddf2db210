#!/usr/bin/env bash
# Albumentations has ISONoise, described as camera sensor noise, among the changes that make training pictures
# of cameras. A sensor's noise depends on a pixel's light and on the gain. One would expect that a picture of
# an even grey wall becomes noisy, the more so at a high intensity. It stays as it is to the last pixel: the
# noise is proportional to the standard deviation of the whole picture's lightness. The same grey wall
# is noisy as soon as something bright stands beside it.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet albumentations==2.0.8
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import os
import sys

os.environ["NO_ALBUMENTATIONS_UPDATE"] = "1"
import albumentations
import numpy as np

print("Python", sys.version.split()[0], "Albumentations", albumentations.__version__)
noise = albumentations.ISONoise(color_shift=(0.01, 0.01), intensity=(0.5, 0.5), p=1)
wall = np.full((200, 400, 3), 60, np.uint8)
beside_a_lamp = wall.copy()
beside_a_lamp[:, 200:] = 240


def deviation(picture):
    return noise(image=picture)["image"][:, :200].astype(float).std()


print(f"deviation of a wall of level 60: {deviation(wall):.2f}")
print(f"deviation of the same wall beside a lamp: {deviation(beside_a_lamp):.2f}")
assert deviation(wall) == 0
assert deviation(beside_a_lamp) > 3
PYTHON
