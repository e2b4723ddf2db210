"""Print how many of the studies' 95 % intervals hold the true rate, at ten edges of working ranges.

python tests/benchmarks/interval_coverage.py --studies 40 --images 20

Each study reads pictures of its own; the true rate is that of as many others as there are in all
studies of an edge, twice.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import occ_model as occ
from occ_model.results import RateSettings
from occ_model.study.confidence import interval_of_pictures
from occ_model.study.success_rate import right_bits_of_images

EDGES: tuple[tuple[str, str, float], ...] = (
    ("phone-136us", "threshold", 3.45e3),
    ("phone-136us", "threshold", 14.225e3),
    ("phone-136us", "matched", 1.8e3),
    ("phone-136us", "equalizer", 3.45e3),
    ("phone-136us", "sequence", 1.85e3),
    ("phone-68us", "threshold", 28.25e3),
    ("phone-68us", "threshold", 3.4e3),
    ("tablet-122us", "threshold", 15.98e3),
    ("phone-136us", "equalizer", 29e3),
    ("tablet-61us", "matched", 1.6e3),
)
"""Preset, decoder and frequency."""


def right_of_each(edge: int, images: int, seed: int) -> np.ndarray:
    """Count the right bits of each picture at an edge."""
    preset, decoder, frequency = EDGES[edge]
    scene = occ.load_preset(preset).replace(switching_frequency=frequency)
    settings = RateSettings(images, (decoder,), seed)
    return np.array([right for (right,) in right_bits_of_images(scene, settings)])


def main() -> None:
    """Measure and print a line an edge."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--studies", type=int, default=40)
    parser.add_argument("--images", type=int, default=20)
    asked = parser.parse_args()
    print("| preset | decoder | frequency | true rate | intervals that hold it |")
    print("|---|---|---|---|---|")
    total, bits = asked.studies * asked.images, 10
    held = 0
    with ProcessPoolExecutor(2) as processes:
        jobs = [
            [processes.submit(right_of_each, edge, size, seed) for seed, size in enumerate(sizes)]
            for edge in range(len(EDGES))
            for sizes in ((2 * total, *[asked.images] * asked.studies),)
        ]
        for (preset, decoder, frequency), (truth, *studies) in zip(EDGES, jobs, strict=True):
            rate = 100.0 * float(truth.result().mean()) / bits
            ends = [
                interval_of_pictures(int(study.result().sum()), asked.images * bits, asked.images)
                for study in studies
            ]
            hold = sum(low <= rate <= high for low, high in ends)
            held += hold
            at = f"{frequency / 1e3:g} kHz"
            print(f"| {preset} | {decoder} | {at} | {rate:.1f} % | {hold} of {len(ends)} |")
    print(f"| all | | | | {100.0 * held / len(EDGES) / asked.studies:.1f} % |")


if __name__ == "__main__":
    main()
