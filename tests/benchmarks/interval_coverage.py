"""Print how many 95 % intervals hold the end of a working range, for ten such ends.

python tests/benchmarks/interval_coverage.py --studies 40 --seed 0

Each study scans values about an end with pictures of its own. The true end is where the success
rate in the pictures of all studies falls to the required one; outwards it is taken to fall only.
"""

import argparse
import math
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np
from scipy.optimize import isotonic_regression

import occ_model as occ
from occ_model.results.sweep_request import RateSettings
from occ_model.study.range_end import Bracket, EndSearch
from occ_model.study.success_rate import ImageSeries, read_ahead
from occ_model.study.value_images import FEW_IMAGES
from occ_model.study.working_range import READ_RATE, STEP

FREQUENCY, EXPOSURE = "switching_frequency", "exposure_time"
ENDS: tuple[tuple[str, str, str, float, int], ...] = (
    ("phone-136us", "threshold", FREQUENCY, 3.59e3, -1),
    ("phone-136us", "threshold", FREQUENCY, 14.0e3, 1),
    ("phone-136us", "threshold", EXPOSURE, 191.5e-6, 1),
    ("phone-136us", "matched", FREQUENCY, 1.89e3, -1),
    ("phone-68us", "threshold", FREQUENCY, 3.58e3, -1),
    ("tablet-122us", "equalizer", FREQUENCY, 3.1e3, -1),
    ("tablet-61us", "threshold", FREQUENCY, 31.2e3, 1),
    ("phone-136us-real", "equalizer", FREQUENCY, 3.58e3, -1),
    ("phone-136us-real", "threshold", FREQUENCY, 13.5e3, 1),
    ("tablet-122us-real", "threshold", FREQUENCY, 15.1e3, 1),
)
"""Preset, decoder, parameter, about where the end is, and whether it is the highest (1)."""

Study = tuple[tuple[float, float] | None, dict[float, list[float]]]


def study_end(end: int, seed: int) -> Study:
    """Return the interval of an end, and the fractions of lost bits by value."""
    preset, decoder, name, about, outwards = ENDS[end]
    scene, settings = occ.load_preset(preset), RateSettings(20, (decoder,))
    random = np.random.default_rng([end, seed])
    bits = scene.transmitter.payload_length

    def measure(values: Sequence[float], images: int) -> list[list[float]]:
        series = [
            ImageSeries(scene.replace(**{name: value}), int(random.integers(2**32)), range(images))
            for value in values
        ]
        counts = read_ahead(series, settings, lambda: None)
        return [[1.0 - right / bits for right in each] for each in counts]

    step = STEP**outwards
    # From about four steps inside, go outwards to the first value at which pictures lose bits.
    innermost = value = about / step**4 * float(step ** random.uniform())
    while not any(measure([value * step], FEW_IMAGES)[0]):
        value *= step
    search = EndSearch(measure, READ_RATE, settings.images)
    found = search.find(Bracket(value, value * step, innermost, value * step**5))
    return found.interval if found else None, search.lost


def true_end(lost: dict[float, list[float]], outwards: int) -> float:
    values = sorted((value for value in lost if lost[value]), reverse=outwards < 0)
    means, images = [np.mean(lost[value]) for value in values], [len(lost[v]) for v in values]
    rising = isotonic_regression(means, weights=images).x
    place = int(np.argmax(rising > 1.0 - READ_RATE / 100.0))
    pair = slice(place - 1, place + 1)
    at = np.interp(1.0 - READ_RATE / 100.0, rising[pair], np.log(values)[pair])
    return math.exp(float(at))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--studies", type=int, default=40)
    parser.add_argument("--seed", type=int, default=0, help="of the first; others follow")
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    print("| preset | decoder | end | intervals that hold it | median width | images |")
    print("|---|---|---|---|---|---|")
    total = held = 0
    with ProcessPoolExecutor(asked.jobs) as processes:
        for end, (preset, decoder, _, _, outwards) in enumerate(ENDS):
            seeds = range(asked.seed, asked.seed + asked.studies)
            studies = list(processes.map(partial(study_end, end), seeds))
            pooled: dict[float, list[float]] = {}
            for _, lost in studies:
                for value, fractions in lost.items():
                    pooled.setdefault(value, []).extend(fractions)
            truth = true_end(pooled, outwards)
            intervals = [sorted(interval) for interval, _ in studies if interval]
            hold = sum(low <= truth <= high for low, high in intervals)
            total, held = total + len(intervals), held + hold
            width = 100.0 * float(np.median([high / low - 1.0 for low, high in intervals]))
            images = sum(map(len, pooled.values())) / len(studies)
            cells = preset, decoder, f"{truth:.5g}", f"{hold} of {len(intervals)}"
            print(f"| {' | '.join(cells)} | {width:.2f} % | {images:.0f} |", flush=True)
    print(f"| all | | | {100.0 * held / total:.1f} % of {total} | | |")


if __name__ == "__main__":
    main()
