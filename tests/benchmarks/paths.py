"""Print the agreement of the profile path with the image path, as a Markdown table.

python tests/benchmarks/paths.py --scenes 200 --images 200
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from physics.paths import DECODERS, TwoPaths, compared, significance

METHODS = ("equalization", "stretch", "none")


def main() -> None:
    """Compare both paths and print a line for each decoder and enhancement."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--images", type=int, default=200)
    parser.add_argument("--seed", type=int, default=2)
    asked = parser.parse_args()
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


def show(decoder: str, method: str, pairs: list[TwoPaths]) -> None:
    """Print a line of the table."""
    probability, terms = significance(pairs)
    off = np.mean([100.0 * (pair.profile.mean() - pair.image.mean()) for pair in pairs])
    print(f"| {decoder} | {method} | {len(pairs)} | {terms} | {off:+.2f} | {probability:.2f} |")


if __name__ == "__main__":
    main()
