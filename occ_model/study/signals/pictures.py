"""The pictures of a study: their start times and noise from seeds, in batches or as a whole."""

import math
from collections.abc import Iterable, Sequence
from functools import lru_cache

import numpy as np

from occ_model.effects.effect import paper_view_of
from occ_model.receiver.signal import column_means, locate
from occ_model.results.frame import Plan
from occ_model.results.sweep_request import SignalPath
from occ_model.scene.scene import Scene
from occ_model.simulation.render import render_plan
from occ_model.study.signals.batch import Observation, simulate_images
from occ_model.study.signals.exposed import Image
from occ_model.transmitter.scheme import sent_chips

_SEEDS = 2**32


@lru_cache(maxsize=1024)
def _seed_of(seed: int, image: int) -> np.random.SeedSequence:
    """Return the seed of an image, a child of ``seed`` that is the same at every point."""
    return np.random.SeedSequence(seed, spawn_key=(image,))


def image_of(scene: Scene, plan: Plan, seed: int, number: int) -> Image:
    """Return a picture of a study, at a random time within a packet and phase of the mains."""
    random = np.random.default_rng(_seed_of(seed, number))
    transmitter = scene.transmitter
    duration = len(sent_chips(transmitter)) * transmitter.switching_period
    start_time, phase = float(random.uniform(0.0, duration)), scene.surroundings.flicker_phase
    if scene.surroundings.flicker_depth:  # the mains are not synchronous with the packets
        phase = float(random.uniform(-math.pi, math.pi))
    return Image(scene, plan, start_time, phase, random)


def picture_itself(scene: Scene, plan: Plan, seed: int) -> Image:
    """Return the picture of a scene at its own start time."""
    random = np.random.default_rng(seed)
    phase = scene.surroundings.flicker_phase
    return Image(scene, plan, scene.model.start_time, phase, random)


def observe_images(images: Sequence[Image], path: SignalPath) -> Iterable[Observation | None]:
    """Simulate the signals that decoders read; None where a picture shows no panel.

    ``path``: ``"image"`` simulates whole pictures, any other a batch.
    """
    return map(_observe_whole, images) if path == "image" else simulate_images(images)


def _observe_whole(image: Image) -> Observation | None:
    scene = image.scene.replace(start_time=image.start_time, flicker_phase=image.flicker_phase)
    seed = int(image.random.integers(_SEEDS))
    picture = render_plan(paper_view_of(scene), image.plan, seed=seed).image
    bright_area = locate(picture, scene.receiver.bright_fraction)
    if bright_area is None:
        return None
    region = bright_area.region
    return Observation(column_means(picture, region), region)
