"""Print at which frequency the paper's decoder ceases to read, as a Markdown table.

    python tests/benchmarks/cessation.py

For each exposure of the paper beyond the band model, each enhancement and some noise: the highest
frequency at which 99 % of the bits are read, beside the null of an alternating pattern, 2 / t.
"""

import argparse

import numpy as np

import occ_model as occ
from occ_model.camera.photometry import level_values
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.noise_spread import NoiseSpread
from occ_model.effects.registry import NAMES, named
from occ_model.scene.scene import Scene
from occ_model.study import theory

PRESETS = ("phone-136us", "tablet-122us")
METHODS = ("equalization", "stretch", "none")
NOISE = (0.5, 1.0, 2.0)
"""Standard deviations of a lit pixel, in grey levels."""


def with_noise(scene: Scene, levels: float) -> Scene:
    """Change the size of the pixels until a lit one has this noise; it holds as much more light."""
    lit = np.array([[level_values(scene)[1]]], dtype=np.float32)

    def of_pitch(pitch: float) -> Scene:
        return scene.replace(pixel_pitch=pitch)

    low, high = 1e-7, 1e-4  # much noise, and little
    for _ in range(40):
        middle = (low * high) ** 0.5
        found = float(NoiseSpread(named(NAMES, NoiseEffect), of_pitch(middle))(lit)[0, 0])
        low, high = (middle, high) if found > levels else (low, middle)
    return of_pitch(high)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--images", type=int, default=20)
    images = parser.parse_args().images
    print("| preset | 2 / t | enhancement | as it is | 0.5 levels | 1 level | 2 levels |")
    print("|---|---|---|---|---|---|---|")
    for preset in PRESETS:
        scene = occ.load_preset(preset).replace(gain_variation=0.0)
        null = f"{theory.null_frequency(scene) / 1e3:.2f}"
        for method in METHODS:
            enhanced = scene.replace(enhancement=method)
            scenes = [enhanced, *(with_noise(enhanced, noise) for noise in NOISE)]
            ends = [occ.limits(each, images=images).highest_frequency for each in scenes]
            cells = ["none" if end is None else f"{end / 1e3:.2f}" for end in ends]
            print(f"| {preset} | {null} | {method} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
