#!/usr/bin/env bash
# VLCsim simulates networks of lamps that send by visible light, and counts the light that reaches a receiver by
# one reflection at the four walls. A wall is cut into elements, each of which adds its area times a known
# law. One would expect the integral of that law in rooms of any shape. In square rooms it is. In a long room
# the number of a wall's elements follows from one side of the room and their area from the other, so that a
# wall counts with the area of its neighbour: in a hall of 4 m by 16 m a quarter of the light is left.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet vlcsim==0.8.1 numpy==1.26.4
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version

import numpy as np
from vlcsim import Receiver, Scenario, VLed

print("Python", sys.version.split()[0], "VLCsim", version("vlcsim"))
HEIGHT, REFLECTED, AREA = 3.0, 0.8, 1e-4
LAMP, DETECTOR = np.array([0.0, 0.0, 2.99]), np.array([0.5, 1.0, 0.0])


def simulated_power(width, length):
    VLed.numberOfVLeds = 0
    room = Scenario(width, length, HEIGHT, 10, REFLECTED)
    room.addVLed(VLed(*LAMP, 1, 1, 1000.0, 60.0))  # 1000 mW, Lambertian
    receiver = Receiver(*DETECTOR, AREA, 1.0, 1.0, 90.0)
    return room.getPowerInPointFromWalls(receiver, 0)


def power_by_the_law(width, length, step=0.02):
    power = 0.0
    for axis, distance, span in ((0, width / 2, length), (1, length / 2, width)):
        along, up = np.meshgrid(np.arange(-span / 2, span / 2, step) + step / 2, np.arange(0, HEIGHT, step) + step / 2)
        for side in (-distance, distance):
            wall = np.empty((*along.shape, 3))
            wall[..., axis], wall[..., 1 - axis], wall[..., 2] = side, along, up
            to_wall, to_detector = wall - LAMP, wall - DETECTOR
            far, near = np.sum(to_wall**2, axis=-1), np.sum(to_detector**2, axis=-1)
            cosines = np.abs(to_wall[..., 2] * to_wall[..., axis] * to_detector[..., axis] * to_detector[..., 2])
            power += 1000 * REFLECTED * AREA / np.pi**2 * np.sum(cosines / (far * near) ** 2) * step**2
    return power


for width, length, lowest, highest in ((5, 5, 0.94, 0.96), (4, 8, 0.58, 0.60), (4, 16, 0.24, 0.25)):
    ratio = simulated_power(width, length) / power_by_the_law(width, length)
    print(f"a room of {width} m by {length} m: {ratio:.3f} of the light by the law")
    assert lowest < ratio < highest
PYTHON
