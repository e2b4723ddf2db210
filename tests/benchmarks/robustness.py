"""How many of all codes are read from tilted, cut-off and noisy pictures, by each decoder.

``python tests/benchmarks/robustness.py`` prints the table of ``resources/docs/decoders.md``.
Each code gets one picture a cell, with a random start time; every picture is made whole and decoded
from its pixels.
"""

import argparse
import math
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.photometry import level_values
from occ_model.camera.projection import row_spans
from occ_model.receiver.decoders import DECODERS
from occ_model.scene.scene import Scene

POSES: dict[str, dict[str, float]] = {
    "level": {},
    "roll 30°": {"roll": math.radians(30)},
    "yaw 30°": {"yaw": math.radians(30)},
    "pitch 30°": {"pitch": math.radians(30)},
    "two thirds outside": {"offset_x": 0.6},
}
NOISES = (1.0, 3.0, 10.0)


def noisy_image(scene: Scene, noise: float, random: np.random.Generator) -> ByteArray:
    """Make the image with this many grey levels of noise in each pixel, whatever its light."""
    profile = occ.column_profile(scene)
    enhancement = Enhancement(profile, scene.model.enhancement)
    rows = scene.camera.rows
    values = float(level_values(scene)[0]) + noise * random.standard_normal((rows, len(profile)))
    image = to_bytes(values)
    first, last = row_spans(occ.panel_corners(scene), rows, len(profile))
    for row in range(rows):
        panel = slice(int(first[row]), int(last[row]))
        deviations = noise * random.standard_normal(panel.stop - panel.start)
        image[row, panel] = enhancement(profile[panel] + deviations)
    return image


def codes_read(pose: str, noise: float, codes: int) -> list[int]:
    """Count the codes that each decoder reads in one pose at one noise."""
    base = occ.load_preset("phone-136us").replace(
        switching_frequency=10e3, distance=1.0, rows=480, panel_height=0.1, **POSES[pose]
    )
    # The same angle of view as the whole sensor, of which only the middle rows are read.
    whole = occ.load_preset("phone-136us").camera
    base = base.replace(
        equivalent_focal_length=whole.equivalent_focal_length
        * whole.focal_length_pixels
        / base.camera.focal_length_pixels
    )
    random = np.random.default_rng((int(noise), *pose.encode()))
    read = [0] * len(DECODERS)
    for code in np.linspace(0, 1023, codes).astype(int).tolist():
        scene = base.replace(code=code, start_time=float(random.uniform(0.0, 2.4e-3)))
        image = noisy_image(scene, noise, random)
        for place, name in enumerate(DECODERS):
            read[place] += occ.decode(image, scene, name).code == code
    return read


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--codes", type=int, default=1024, help="how many of the 1024 codes")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    names = [f"{name}, noise {noise:.0f}" for noise in NOISES for name in DECODERS]
    print(f"| pose | {' | '.join(names)} |\n|---{'|---' * len(names)}|", flush=True)
    with ProcessPoolExecutor(options.jobs) as pool:
        for pose in POSES:
            cells = pool.map(partial(codes_read, pose, codes=options.codes), NOISES)
            shares = [100.0 * read / options.codes for cell in cells for read in cell]
            print(f"| {pose} | {' | '.join(f'{share:.1f} %' for share in shares)} |", flush=True)


if __name__ == "__main__":
    main()
