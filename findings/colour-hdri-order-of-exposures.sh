#!/usr/bin/env bash
# A lamp is hundreds of times brighter than the wall that it lights, and is measured by several exposures, which
# colour-hdri merges to one picture of the light. Each exposure comes with its own aperture, time and speed, so
# that one would expect that their order does not matter. It does, without a word in the function's
# description: the first one is taken for the shortest, and its saturated pixels count fully, the last one
# for the longest. From the longest to the shortest, against the wall's light everything that is brighter
# comes out too dark, the lamp by a half. Stacks that are read from files are sorted; those that are put together
# from arrays are not. And the pixels of such a stack are gone when it has been merged once.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet colour-hdri==0.2.6 colour-science==0.4.7 numpy==2.4.6
cd "$folder"
"$folder/venv/bin/python" -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
from colour_hdri import Image, ImageStack, Metadata, image_stack_to_HDRI

print("Python", sys.version.split()[0], "colour-hdri", version("colour-hdri"), "colour", version("colour-science"))
LIGHT = np.array([100.0, 500.0, 1000.0, 5000.0, 20000.0])  # from the wall to the lamp
TIMES = (1 / 25000, 1 / 2500, 1 / 250)


def exposure(time):
    levels = np.round(np.clip(LIGHT * time, 0, 1) * 4095) / 4095
    settings = Metadata(f_number=np.array([4.0]), exposure_time=np.array([time]), iso=np.array([100.0]))
    return Image(data=np.tile(levels[np.newaxis, :, np.newaxis], (1, 1, 3)), metadata=settings)


def stack_of(times):
    stack = ImageStack()
    for time in times:
        stack.append(exposure(time))
    return stack


merged = {}
for name, times in (("shortest first", TIMES), ("longest first", TIMES[::-1])):
    stack = stack_of(times)
    light = image_stack_to_HDRI(stack)[0, :, 0]
    merged[name] = light / light[0] * LIGHT[0]
    print(f"{name}: {np.round(merged[name])}, expected {LIGHT}, pixels left in the stack: {stack[0].data is not None}")
    assert stack[0].data is None
assert np.allclose(merged["shortest first"], LIGHT, rtol=0.01)
assert np.allclose(merged["longest first"] / LIGHT, [1, 0.81, 0.76, 0.53, 0.51], atol=0.01)
PYTHON
