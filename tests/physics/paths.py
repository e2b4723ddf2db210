"""Success rates by studies and by whole pictures, side by side for random scenes."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc

import occ_model as occ
from occ_model.results.sweep_request import RateSettings, SignalPath
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.study.success_rate import right_bits_of_images

PRESETS = ("phone-68us", "phone-136us", "tablet-61us", "tablet-122us", "phone-136us-real")

DECODERS = ("threshold", "matched", "equalizer", "sequence")
IN_DOUBT = (0.05, 0.95)  # a rate between these is in doubt


@dataclass(frozen=True)
class TwoPaths:
    """The fraction of right bits in images of one scene, by a study and by whole pictures.

    Parameters
    ----------
    study, image : ndarray of float64, shape (images,)
        The fraction in each image. Those of one place start at the same time, with other noise.
    """

    number: int
    scene: Scene
    decoder: str
    study: np.ndarray
    image: np.ndarray

    @property
    def preset(self) -> str:
        """The preset of the scene, as its timing tells."""
        exposure = round(1e6 * self.scene.camera.exposure_time)
        real = "-real" if self.scene.lens.radial_k1 else ""
        return next(name for name in PRESETS if name.endswith(f"-{exposure}us{real}"))

    @property
    def rate(self) -> float:
        """The rate of all images."""
        return float((self.study.mean() + self.image.mean()) / 2.0)

    @property
    def is_in_doubt(self) -> bool:
        return IN_DOUBT[0] < self.rate < IN_DOUBT[1]

    @property
    def deviation(self) -> float:
        """The difference of the rates in standard deviations; 0 if no image differs.

        The standard deviation is that over all ways to exchange the two images of a pair. If both
        are alike, the mean square is then exactly 1, however few images there are, and whichever
        scenes are selected by the rate of all images.
        """
        off = self.study - self.image
        error = math.sqrt(float((off**2).sum()))
        return float(off.sum()) / error if error else 0.0


def random_scene(random: np.random.Generator) -> Scene:
    """Draw a panel on part of a preset's sensor: dark or bright, near or far, at or between nulls.

    The exposure is 1.5 to 16 chips long. Every fifth scene has a lens, a file and flicker, so that
    its rows differ and a study reads a sample of them.
    """
    scene = occ.load_preset(PRESETS[int(random.integers(len(PRESETS)))])
    null = random.random() < 0.3
    ratio = (
        2.0 * int(random.integers(1, 5)) + random.uniform(-0.15, 0.15)
        if null
        else random.uniform(1.5, 2.2)
        if random.random() < 0.4
        else random.uniform(2.2, 16.0)
    )
    differ = scene.lens.radial_k1 != 0.0
    changes: dict[str, ParameterValue] = {
        "rows": scene.camera.rows
        // int(random.integers(4, 7) if differ else random.integers(12, 25)),
        "columns": scene.camera.columns // 2,
        "readout_time": scene.camera.readout_time * 2.0,
        "panel_width": scene.transmitter.panel_width * float(random.uniform(0.8, 1.6)),
        "code": int(random.integers(1024)),
        "enhancement": ("equalization", "stretch", "none")[int(random.integers(3))],
        "distance": float(np.exp(random.uniform(np.log(0.5), np.log(2.5)))),
        "luminance": float(np.exp(random.uniform(np.log(40.0), np.log(4000.0)))),
        "read_noise": float(random.uniform(1.0, 12.0)),
        "iso": float(100.0 * 2.0 ** random.uniform(0.0, 3.0)),
        "switching_frequency": float(ratio) / scene.camera.exposure_time,
    }
    if random.random() < 0.3:
        payload = "".join(map(str, random.integers(0, 2, 16).tolist()))
        changes |= {
            "line_code": "manchester", "framing": "preamble", "payload": f"bits:{payload}"
        }  # fmt: skip
    return scene.replace(**changes)


def fractions(scene: Scene, path: SignalPath, images: int, seed: int) -> np.ndarray:
    """Return the fraction of right bits in each image with all effects: (images, decoders)."""
    settings = RateSettings(images, DECODERS, seed, tolerance=0.0, path=path)
    counts = np.array([*right_bits_of_images(scene, settings)])
    return np.asarray(counts / scene.transmitter.payload_length)


def scene_in_doubt(number: int, seed: int, tries: int = 60, images: int = 4) -> Scene:
    """Draw scenes until a decoder, each in turn, reads some but not all of a few images.

    These images choose the scene and are not counted.
    """
    settings = RateSettings(images, (DECODERS[number % len(DECODERS)],), 900_000_000 + number)
    random = np.random.default_rng([seed, number])
    for _ in range(tries):
        scene = random_scene(random)
        read = [right for (right,) in right_bits_of_images(scene, settings)]
        if IN_DOUBT[0] < sum(read) / (images * scene.transmitter.payload_length) < IN_DOUBT[1]:
            break
    return scene


def compare_paths(scenes: Iterable[int], images: int, seed: int) -> Iterator[TwoPaths]:
    """Compare a study with whole pictures at some scenes."""
    for number in scenes:
        scene = random_scene(np.random.default_rng([seed, number]))
        yield from compare_paths_at(scene, images, number)


def compare_paths_at(scene: Scene, images: int, number: int) -> Iterator[TwoPaths]:
    """Compare both at a scene, by images that start at the same times."""
    by_study, by_image = (fractions(scene, path, images, number) for path in ("auto", "image"))
    for place, decoder in enumerate(DECODERS):
        yield TwoPaths(number, scene, decoder, by_study[:, place], by_image[:, place])


def significance(found: list[TwoPaths]) -> tuple[float, int, float]:
    """Test whether the rates agree: chi-square, its terms, and the probability of a larger one.

    Only rates in doubt count, where some pair of images differs.
    """
    counted = [pair for pair in found if pair.is_in_doubt and pair.deviation]
    total = sum(pair.deviation**2 for pair in counted)
    return total, len(counted), float(chdtrc(len(counted), total))
