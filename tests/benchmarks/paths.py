"""Print the agreement of the profile path with the image path, as a Markdown table.

python tests/benchmarks/paths.py --scenes 200 --images 200
python tests/benchmarks/paths.py --pictures

The second prints the rates of the phone's whole pictures round the end of its working range.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

import occ_model as occ

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from physics.paths import DECODERS, TwoPaths, compared, significance

METHODS = ("equalization", "stretch", "none")


def main() -> None:
    """Compare both paths and print a line for each decoder and enhancement."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--images", type=int, default=200)
    parser.add_argument("--seed", type=int, default=2)
    parser.add_argument("--pictures", action="store_true")
    asked = parser.parse_args()
    if asked.pictures:
        compare_pictures()
        return
    found = list(compared(asked.scenes, asked.images, asked.seed))
    print("| decoder | enhancement | scenes | in doubt | mean difference, points | p |")
    print("|---|---|---|---|---|---|")
    for decoder in DECODERS:
        for method in METHODS:
            show(
                decoder,
                method,
                [p for p in found if p.decoder == decoder and p.scene.model.enhancement == method],
            )
    show("both", "all", found)


def compare_pictures() -> None:
    """Print the study's rate and the share of whole pictures that are read."""
    scene = occ.load_preset("phone-136us")
    end = occ.limits(scene).frequency.highest
    inside = [end.inside.value] if end is not None and end.inside is not None else []
    print("| frequency | success rate by the study | of 20 whole pictures, bits right |")
    print("|---|---|---|")
    for frequency in (*inside, 14.2e3, 14.3e3, 14.4e3, 14.5e3, 14.6e3, 14.68e3):
        at = scene.replace(switching_frequency=frequency)
        study = occ.success_rate(at, images=20)
        pictures = occ.success_rate(at, images=20, seed=99, path="image")
        print(f"| {frequency / 1e3:.2f} kHz | {study:.0f} % | {pictures:.0f} % |", flush=True)


def show(decoder: str, method: str, pairs: list[TwoPaths]) -> None:
    """Print a line of the table."""
    probability, terms = significance(pairs)
    off = np.mean([100.0 * (pair.profile.mean() - pair.image.mean()) for pair in pairs])
    print(f"| {decoder} | {method} | {len(pairs)} | {terms} | {off:+.2f} | {probability:.2f} |")


if __name__ == "__main__":
    main()
