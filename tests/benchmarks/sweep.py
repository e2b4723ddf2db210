"""The whole phone grid of the paper's Fig. 5, by the profile path and by whole images.

``python tests/benchmarks/sweep.py`` prints seconds and ratios measured in one run: 10 frequencies,
8 distances, 2 exposure times, 5 images, both decoders: 1,600 decodings. By images only some points
are measured, ``--whole``: all of them; the tables of both paths are compared point by point.
"""

import argparse
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
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


def one_by_one() -> None:
    """Measure the same without a sweep: each decoder its own images."""
    phone = occ.load_preset("phone-136us")
    for exposure in EXPOSURES:
        for frequency in FREQUENCIES:
            for distance in DISTANCES:
                scene = phone.replace(
                    exposure_time=exposure, switching_frequency=frequency, distance=distance
                )
                for decoder in BOTH:
                    occ.success_rate(scene, IMAGES, decoder)


def command(jobs: int) -> None:
    """Sweep by the command line, from the start of Python on."""
    vary = (
        "--vary=exposure_time=68us,136us",
        "--vary=switching_frequency=2kHz:20kHz:2kHz",
        "--vary=distance=0.6:2:0.2",
    )
    program = "import sys; from occ_model.cli import main; sys.exit(main(sys.argv[1:]))"
    subprocess.run(
        [sys.executable, "-c", program, "sweep", *vary, "--decoder=both", f"--jobs={jobs}"],
        check=True,
        capture_output=True,
    )


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
    apart = seconds_of(one_by_one, 3)
    print(f"whole phone grid, in this process           {here:7.2f} s")
    print(f"the same, success_rate one by one           {apart:7.2f} s")
    print(f"2 processes, the first time                 {first:7.2f} s")
    print(f"2 processes, from the second time on        {two:7.2f} s")
    print(f"this process against 2                      {here / two:7.2f}")
    print(f"success_rate one by one against the sweep   {apart / here:7.2f}")
    for jobs in (1, 2):
        cold = seconds_of(partial(command, jobs), 3)
        print(f"the command from its start, --jobs {jobs}        {cold:7.2f} s")
    by_images(GRID if options.whole else SOME)


if __name__ == "__main__":
    main()
