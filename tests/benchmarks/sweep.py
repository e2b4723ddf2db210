"""The whole phone grid of the paper's Fig. 5, by the profile path and by whole images.

``python tests/benchmarks/sweep.py`` prints seconds and ratios measured in one run: 10 frequencies,
8 distances, 2 exposure times, 5 images, both decoders: 1,600 decodings. By images only some points
are measured, ``--whole``: all of them; the tables of both paths are compared point by point.
"""

import argparse
from collections.abc import Callable, Mapping, Sequence
from time import perf_counter

import numpy as np

import occ_model as occ
from occ_model.study.paper_grid import DISTANCES, FREQUENCIES, IMAGES

BOTH = ("threshold", "matched")
EXPOSURES = (68e-6, 136e-6)
GRID: dict[str, Sequence[float]] = {
    "exposure_time": EXPOSURES,
    "switching_frequency": FREQUENCIES,
    "distance": DISTANCES,
}
SOME: dict[str, Sequence[float]] = {
    **GRID,
    "switching_frequency": FREQUENCIES[1::3],
    "distance": DISTANCES[::4],
}
ROUNDS = 5


def seconds_of(work: Callable[[], object], rounds: int = ROUNDS) -> float:
    """Give the median time of some runs."""
    spent = []
    for _ in range(rounds):
        start = perf_counter()
        work()
        spent.append(perf_counter() - start)
    return float(np.median(spent))


def swept(axes: Mapping[str, Sequence[float]], **settings: object) -> occ.SweepTable:
    phone = occ.load_preset("phone-136us")
    return occ.sweep(phone, axes, IMAGES, BOTH, **settings)  # type: ignore[arg-type]


def by_images(axes: Mapping[str, Sequence[float]]) -> None:
    """Compare both paths."""
    swept(axes)
    start = perf_counter()
    profile = swept(axes, path="profile")
    middle = perf_counter()
    image = swept(axes, path="image")
    end = perf_counter()
    points, alike = profile.sent.size, int((profile.right == image.right).all(axis=-1).sum())
    print(f"image path, {points} points in this process    {end - middle:7.2f} s")
    print(f"profile path, the same points               {middle - start:7.2f} s")
    print(f"image path against profile path             {(end - middle) / (middle - start):7.1f}")
    print(f"points at which both tables are the same    {alike:4d} of {points}")
    for row, other in zip(profile.rows, image.rows, strict=True):
        if row.right != other.right:
            print(f"    {row.decoder} {dict(row.point)}: {row.rate} %, by images {other.rate} %")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--whole", action="store_true", help="the whole grid by images, too")
    options = parser.parse_args()
    swept(GRID)
    here = seconds_of(lambda: swept(GRID))
    start = perf_counter()
    swept(GRID, jobs=2)
    first = perf_counter() - start
    two = seconds_of(lambda: swept(GRID, jobs=2))
    print(f"whole phone grid, in this process           {here:7.2f} s")
    print(f"2 processes, the first time                 {first:7.2f} s")
    print(f"2 processes, from the second time on        {two:7.2f} s")
    print(f"this process against 2                      {here / two:7.2f}")
    by_images(GRID if options.whole else SOME)


if __name__ == "__main__":
    main()
