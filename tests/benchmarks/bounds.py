"""What a match leaves unused of a photo: ``python tests/benchmarks/bounds.py [photos] [first]``.

The Cramer-Rao bound of a photograph's readout and exposure time beside that of the means of its
columns: with independent noise, with JPEG's rounding alike in all rows, and without the columns
beside clipped ones, which a match leaves out.
"""

import sys
from pathlib import Path

import numpy as np
from tqdm import tqdm

sys.path.insert(0, str(Path(__file__).parents[1]))

from photo_world.bounds import bound_of_picture, bound_of_profile
from photo_world.photograph import random_world

LEFT_OUT = 3
"""Columns beside a clipped one, as a match leaves them out."""

WHAT = {
    "means of columns": {},
    "and JPEG alike in all rows": {"jpeg_alike": True},
    "and columns beside clipped ones left out": {"beside_clipped": LEFT_OUT},
    "and both": {"jpeg_alike": True, "beside_clipped": LEFT_OUT},
}


def ratios(seed: int) -> list[np.ndarray]:
    """Give each bound of a photograph over that of all its pixels, for readout and exposure."""
    world = random_world(seed)
    whole = np.array(bound_of_picture(world))
    return [np.array(bound_of_profile(world, **kind)) / whole for kind in WHAT.values()]  # type: ignore[arg-type]


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    found = np.array([ratios(seed) for seed in tqdm(range(first, first + count), "bounds")])
    print("| bound by | readout | exposure |\n|---|---|---|")
    for name, (readout, exposure) in zip(WHAT, np.median(found, axis=0), strict=True):
        print(f"| {name} | {readout:.2f} | {exposure:.2f} |")
