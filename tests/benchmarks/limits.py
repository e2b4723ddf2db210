"""Print the table of limits of all presets, with the processor time of each line's search.

python tests/benchmarks/limits.py
python tests/benchmarks/limits.py --preset phone-136us --decoder threshold

``--total`` prints the processor time of the command ``limits`` until the first decoder's limits are
known and until all are, with the images that it reads.
``--cessation`` prints, for each exposure of the paper beyond the band model, each enhancement and
some noise, the highest frequency at which 99 % of the bits are read by the paper's decoder.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from functools import partial
from itertools import count
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from scene_values import presets_of_codes

import occ_model as occ
from occ_model.camera.photometry import level_values
from occ_model.commands.limits import range_cells
from occ_model.effects.noise import law_of
from occ_model.effects.registry import NAMES
from occ_model.results.limits import Limits
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study import theory
from occ_model.study.limits import SEARCHED_PARAMETERS, limits_of
from occ_model.study.working_range import working_range

COLUMNS = (
    "preset", "decoder", "lowest", "highest", "again", "shortest", "longest", "again",
    "bits a second", "time", "images",
)  # fmt: skip

RATE, IMAGES, SEED = 99.0, 20, 1

_BEYOND = ("phone-136us", "tablet-122us")
_METHODS = ("equalization", "stretch", "none")
_NOISE = (0.5, 1.0, 2.0)
"""Standard deviations of a lit pixel, in grey levels."""


def line(preset: str, decoder: str) -> str:
    """Search for the limits of a decoder and write them as a line of the table."""
    scene, settings = occ.load_preset(preset), RateSettings(IMAGES, (decoder,), SEED)
    beats = count()
    start = time.process_time()
    ranges = [
        working_range(scene, name, RATE, settings, partial(next, beats))
        for name in SEARCHED_PARAMETERS
    ]
    seconds = time.process_time() - start
    found = Limits(scene, decoder, RATE, IMAGES, SEED, *ranges)
    cells = [preset, decoder, *(cell for each in ranges for cell in range_cells(each))]
    cells += [f"{found.bits_a_second():.4g}", f"{seconds:.1f} s", f"{next(beats)}"]
    return f"| {' | '.join(cells)} |"


def total(preset: str, decoders: Sequence[str]) -> str:
    """Search for the limits of decoders in one process."""
    scene, settings = occ.load_preset(preset), RateSettings(IMAGES, tuple(decoders), SEED)
    beats = count()
    start = time.process_time()
    first = None
    for _ in limits_of(scene, settings, RATE, heartbeat=partial(next, beats)):
        first = first or time.process_time() - start
    seconds = time.process_time() - start
    return f"| {preset} | {first or 0.0:.1f} s | {seconds:.1f} s | {next(beats)} |"


def with_noise(scene: Scene, levels: float) -> Scene:
    """Change the size of the pixels until a lit one has this noise; it holds as much more light."""
    lit = level_values(scene)[1:]

    def of_pitch(pitch: float) -> Scene:
        return scene.replace(pixel_pitch=pitch)

    low, high = 1e-7, 1e-4  # much noise, and little
    for _ in range(40):
        middle = (low * high) ** 0.5
        law = law_of(of_pitch(middle), NAMES, lit)
        found = 0.0 if law is None else float(law.interpolate(law.deviations, lit)[0])
        low, high = (middle, high) if found > levels else (low, middle)
    return of_pitch(high)


def print_cessation(images: int) -> None:
    """Print where the threshold decoder ceases, beside the null of an alternating pattern."""
    print("| preset | 2 / t | enhancement | as it is | 0.5 levels | 1 level | 2 levels |")
    print("|---|---|---|---|---|---|---|")
    for preset in _BEYOND:
        scene = occ.load_preset(preset).replace(gain_variation=0.0)
        null = f"{theory.null_frequency(scene) / 1e3:.2f}"
        for method in _METHODS:
            enhanced = scene.replace(enhancement=method)
            scenes = [enhanced, *(with_noise(enhanced, noise) for noise in _NOISE)]
            ends = [occ.limits(each, images=images).highest_frequency for each in scenes]
            cells = ["none" if end is None else f"{end / 1e3:.2f}" for end in ends]
            print(f"| {preset} | {null} | {method} | {' | '.join(cells)} |", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--preset", action="append", choices=presets_of_codes())
    parser.add_argument("--decoder", action="append", choices=occ.decoders())
    parser.add_argument("--cessation", action="store_true", help="of the paper's decoder by noise")
    parser.add_argument("--total", action="store_true", help="of the command, for each preset")
    asked = parser.parse_args()
    decoders = asked.decoder or ("threshold", "matched", "equalizer", "sequence")
    if asked.cessation:
        print_cessation(IMAGES)
        return
    if asked.total:
        print("| preset | first decoder | all | images |")
        print("|---|---|---|---|")
        for preset in asked.preset or presets_of_codes():
            print(total(preset, decoders), flush=True)
        return
    print(f"| {' | '.join(COLUMNS)} |")
    print("|---" * len(COLUMNS) + "|")
    for preset in asked.preset or presets_of_codes():
        for decoder in decoders:
            print(line(preset, decoder), flush=True)


if __name__ == "__main__":
    main()
