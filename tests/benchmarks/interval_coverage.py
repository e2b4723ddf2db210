"""Print how many of the studies' 95 % intervals hold the truth.

python tests/benchmarks/interval_coverage.py --studies 40 --images 20 --seed 0

The true rate is asked for at ten edges of working ranges. Each study reads pictures of its own; the
true rate is that of as many others as there are in all studies of an edge, twice.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import occ_model as occ
from occ_model.results.sweep_request import RateSettings
from occ_model.study.confidence import interval_of_pictures
from occ_model.study.success_rate import right_bits_of_images

EDGES: tuple[tuple[str, str, float], ...] = (
    ("phone-136us", "threshold", 3.3e3),
    ("phone-136us", "threshold", 14.23e3),
    ("phone-136us", "matched", 1.75e3),
    ("phone-136us", "equalizer", 14.2e3),
    ("phone-136us", "equalizer", 34.6e3),
    ("phone-136us", "sequence", 1.78e3),
    ("phone-68us", "threshold", 3.3e3),
    ("tablet-122us", "equalizer", 2.7e3),
    ("tablet-61us", "threshold", 31.5e3),
    ("tablet-61us", "matched", 1.52e3),
)
"""Preset, decoder and frequency, at which 10 to 90 % of the bits are read."""


def right_of_each(edge: int, images: int, seed: int) -> np.ndarray:
    """Count the right bits of each picture at an edge."""
    preset, decoder, frequency = EDGES[edge]
    scene = occ.load_preset(preset).replace(switching_frequency=frequency)
    settings = RateSettings(images, (decoder,), seed)
    return np.array([right for (right,) in right_bits_of_images(scene, settings)])


def count_rates(studies: int, images: int, seed: int, processes: ProcessPoolExecutor) -> None:
    print("| preset | decoder | frequency | true rate | intervals that hold it |")
    print("|---|---|---|---|---|")
    total, bits, held = studies * images, 10, 0
    jobs = [
        [
            processes.submit(right_of_each, edge, size, seed + place)
            for place, size in enumerate((2 * total, *[images] * studies))
        ]
        for edge in range(len(EDGES))
    ]
    for (preset, decoder, frequency), (truth, *counts) in zip(EDGES, jobs, strict=True):
        rate = 100.0 * float(truth.result().mean()) / bits
        ends = [
            interval_of_pictures(int(count.result().sum()), images * bits, images)
            for count in counts
        ]
        hold = sum(low <= rate <= high for low, high in ends)
        held += hold
        cells = (preset, decoder, f"{frequency / 1e3:g} kHz", f"{rate:.1f} %")
        print(f"| {' | '.join(cells)} | {hold} of {studies} |", flush=True)
    print(f"| all | | | | {100.0 * held / len(EDGES) / studies:.1f} % |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--studies", type=int, default=40)
    parser.add_argument("--images", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0, help="of the first; others follow")
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    with ProcessPoolExecutor(asked.jobs) as processes:
        count_rates(asked.studies, asked.images, asked.seed, processes)


if __name__ == "__main__":
    main()
