"""Success rates by the profile path and by the image path, side by side at random scenes."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count

import numpy as np
from scipy import stats

import occ_model as occ
from occ_model.results import RateSettings, SignalPath
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.study.success_rate import right_bits_of_images

DECODERS = ("threshold", "matched")
IN_DOUBT = (0.05, 0.95)
"""Between which rates a scene's rate is in doubt."""


@dataclass(frozen=True)
class TwoPaths:
    """The share of right bits in images of one scene, by both paths.

    Parameters
    ----------
    profile, image : ndarray of float64, shape (images,)
        Of each image; the images of the two paths have nothing in common.
    """

    scene: Scene
    decoder: str
    profile: np.ndarray
    image: np.ndarray

    @property
    def rate(self) -> float:
        """The rate of all images."""
        return float((self.profile.mean() + self.image.mean()) / 2.0)

    @property
    def is_in_doubt(self) -> bool:
        return IN_DOUBT[0] < self.rate < IN_DOUBT[1]

    @property
    def deviation(self) -> float:
        """The difference of the rates over its standard error; 0 where no image differs."""
        off = float(self.profile.mean() - self.image.mean())
        variance = (self.profile.var() + self.image.var()) / len(self.image)
        if variance:
            return off / math.sqrt(variance)
        return math.inf if off else 0.0


def random_scene(random: np.random.Generator) -> Scene:
    """A level panel on part of a preset's sensor, the exposure 1.5 to 30 chips long."""
    names = [name for name in occ.presets() if not name.endswith("-real")]
    scene = occ.load_preset(names[int(random.integers(len(names)))])
    ratio = random.uniform(1.5, 2.2) if random.random() < 0.5 else random.uniform(2.2, 30.0)
    changes: dict[str, ParameterValue] = {
        "rows": scene.camera.rows // int(random.integers(16, 33)),
        "columns": scene.camera.columns // 2,
        "readout_time": scene.camera.readout_time * 2.0,
        "panel_width": scene.transmitter.panel_width * float(random.uniform(0.8, 1.6)),
        "code": int(random.integers(1024)),
        "enhancement": ("equalization", "stretch", "none")[int(random.integers(3))],
        "distance": float(random.uniform(0.5, 1.4)),
        "iso": float(100.0 * 2.0 ** random.uniform(0.0, 3.0)),
        "switching_frequency": float(ratio) / scene.camera.exposure_time,
    }
    return scene.replace(**changes)


def shares(scene: Scene, path: SignalPath, images: int, seed: int) -> np.ndarray:
    """The share of right bits in each image, shape (images, decoders)."""
    settings = RateSettings(images, DECODERS, seed, path=path)
    return np.array([*right_bits_of_images(scene, settings)]) / scene.transmitter.bits


def is_in_doubt(scene: Scene) -> bool:
    """Whether a rate of a few images is in doubt, and will be so of others.

    Most scenes show by the first images that none is.
    """
    low, high = 2.0 * IN_DOUBT[0], 1.0 - 2.0 * (1.0 - IN_DOUBT[1])
    for images in (4, 20):
        rates = shares(scene, "profile", images, 1_000_000_000).mean(axis=0)
        if not ((rates > low) & (rates < high)).any():
            return False
    return True


def compared(scenes: int, images: int, seed: int) -> Iterator[TwoPaths]:
    """Compare both paths at some scenes, in every second of which a rate is in doubt."""
    random = np.random.default_rng(seed)
    for number in range(scenes):
        for _ in count():
            scene = random_scene(random)
            if is_in_doubt(scene) == bool(number % 2):
                break
        yield from compared_at(scene, images, number * images)


def compared_at(scene: Scene, images: int, first: int) -> Iterator[TwoPaths]:
    """Compare both paths at a scene, by images with seeds of their own from the first on."""
    by_profile = shares(scene, "profile", images, first)
    by_image = shares(scene, "image", images, 500_000_000 + first)
    for place, decoder in enumerate(DECODERS):
        yield TwoPaths(scene, decoder, by_profile[:, place], by_image[:, place])


def significance(found: list[TwoPaths]) -> tuple[float, int]:
    """Test whether the rates agree: the probability of a larger chi-square, and its terms.

    Only rates in doubt count: elsewhere an image in hundreds differs, whose number is not normal.
    """
    counted = [pair for pair in found if pair.is_in_doubt]
    total = sum(pair.deviation**2 for pair in counted)
    return float(stats.chi2.sf(total, len(counted))), len(counted)
