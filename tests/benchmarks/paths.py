"""Print the agreement of studies with whole pictures, as a Markdown table.

python tests/benchmarks/paths.py --scenes 200 --images 20
python tests/benchmarks/paths.py --scenes 200 --images 8 --any
python tests/benchmarks/paths.py --pictures

The first takes scenes at which one of the decoders, each in turn, is in doubt; the second any. What
is known after every ten of them goes to the standard error. The third prints the rates of the
phone's whole pictures round the end of its working range.
"""

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

import occ_model as occ

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from physics.paths import (
    DECODERS,
    PRESETS,
    TwoPaths,
    compare_paths,
    compare_paths_at,
    scene_in_doubt,
    significance,
)


def main() -> None:
    """Compare studies with pictures and print a line for each decoder and preset."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--images", type=int, default=20)
    parser.add_argument("--seed", type=int, default=2)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--any", action="store_true")
    parser.add_argument("--pictures", action="store_true")
    asked = parser.parse_args()
    if asked.pictures:
        compare_pictures()
        return
    found: list[TwoPaths] = []
    with ProcessPoolExecutor(asked.jobs) as processes:
        jobs = [
            processes.submit(compared_one, number, asked.images, asked.seed, asked.any)
            for number in range(asked.scenes)
        ]
        for done, job in enumerate(jobs, 1):
            found += job.result()
            if done % 10 == 0:
                print(f"{done} scenes: {so_far(found)}", file=sys.stderr, flush=True)
    print("| decoder | preset | scenes | in doubt | mean difference, points | chi-square | p |")
    print("|---|---|---|---|---|---|---|")
    for decoder in DECODERS:
        of_decoder = [pair for pair in found if pair.decoder == decoder]
        for preset in PRESETS:
            show(decoder, preset, [p for p in of_decoder if p.preset == preset])
        show(decoder, "all", of_decoder)
    show("all", "all", found)
    for pair in sorted(found, key=lambda pair: -abs(pair.deviation))[:8]:
        rates = f"{pair.study.mean():.2f} {pair.image.mean():.2f}"
        print(pair.number, pair.preset, pair.decoder, f"{pair.deviation:.2f}", rates)


def compared_one(number: int, images: int, seed: int, any_scene: bool) -> list[TwoPaths]:
    """Compare at one scene, as the job of a process."""
    if any_scene:
        return list(compare_paths((number,), images, seed))
    return list(compare_paths_at(scene_in_doubt(number, seed), images, number))


def so_far(found: list[TwoPaths]) -> str:
    """Write each decoder's p and the rates in doubt that it rests on."""
    parts = []
    for decoder in DECODERS:
        _, terms, probability = significance([pair for pair in found if pair.decoder == decoder])
        parts.append(f"{decoder} {probability:.2f} of {terms}")
    return ", ".join(parts)


def compare_pictures() -> None:
    """Print the study's rate and the fraction of whole pictures that are read."""
    scene = occ.load_preset("phone-136us")
    end = occ.limits(scene).frequency.highest
    inside = [end.value] if end is not None else []
    print("| frequency | success rate by the study | of 20 whole pictures, bits right |")
    print("|---|---|---|")
    for frequency in (*inside, 14.2e3, 14.3e3, 14.4e3, 14.5e3, 14.6e3, 14.68e3):
        at = scene.replace(switching_frequency=frequency)
        study = occ.success_rate(at, images=20)
        pictures = occ.success_rate(at, images=20, seed=99, path="image")
        print(f"| {frequency / 1e3:.2f} kHz | {study:.0f} % | {pictures:.0f} % |", flush=True)


def show(decoder: str, method: str, pairs: list[TwoPaths]) -> None:
    square, terms, probability = significance(pairs)
    off = np.mean([100.0 * (pair.study.mean() - pair.image.mean()) for pair in pairs])
    cells = (decoder, method, len(pairs), terms, f"{off:+.2f}", f"{square:.1f}")
    print(f"| {' | '.join(map(str, cells))} | {probability:.2f} |")


if __name__ == "__main__":
    main()
