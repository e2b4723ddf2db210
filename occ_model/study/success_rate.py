"""Measure the success rate: the fraction of bits read correctly over several images."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.camera.projection import check_size
from occ_model.effects.effect import paper_view_of
from occ_model.effects.plan import signal_plan
from occ_model.effects.registry import NAMES
from occ_model.errors import ParameterError, PluginError
from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.receiver.decode import decoder_named
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, Region
from occ_model.results.frame import Plan
from occ_model.results.sweep_request import MOST_IMAGES, SIGNAL_PATHS, RateSettings, SignalPath
from occ_model.scene.argument_checks import check_choice, check_count, check_seed, check_switches
from occ_model.scene.scene import TOLERANCE, Scene, SimulationSettings
from occ_model.study.observation import Observation, observe, panel_span
from occ_model.transmitter.scheme import check_code, sent_chips

_CACHED_PICTURES = 512
"""Number of pictures whose signals are cached for the next decoder, enough for a search."""
_NO_PANEL = "No panel found: the picture has one grey level."


def success_rate(
    scene: Scene,
    images: int = 5,
    decoder: str = PAPER_DECODER,
    seed: int = 1,
    *,
    tolerance: float = TOLERANCE.default,
    force: Mapping[str, bool] | None = None,
    path: SignalPath = "auto",
) -> float:
    """Return the fraction of bits read correctly over several images, in percent.

    SR = correct bits / (images x bits) x 100, the paper's definition. The images differ in start
    time, evenly distributed over one packet, and in noise. An image in which no bits are read, or
    whose bits the decoder rejects, counts as having none correct. The effects are planned for the
    signal, which is what a decoder reads. Where the column means are computed without pixels,
    planning would take longer than all effects do, so none is omitted.

    Parameters
    ----------
    scene
        The scene; its start time and its flicker's phase are not used.
    decoder
        The decoder's name.
    seed
        Seed of the start times and the noise.
    tolerance, force
        As for :func:`occ_model.plan`.
    path
        ``"image"``: simulate every image as a whole. ``"profile"``: compute the column means
        without an image, which requires that rows differ by noise alone: a level panel, and no
        image effect in the plan. ``"rows"``: estimate the column means from a sample of the rows.
        ``"auto"``: the profile if possible, otherwise a sample of the rows, but the whole image if
        noise beside the panel is as bright as its brightest pixels.

    Returns
    -------
    float
        Percent.

    Raises
    ------
    ParameterError
        An argument is not allowed, no code is sent, or the path is ``"profile"`` and rows differ.
    ProjectionError
        The scene has no picture.
    PluginError
        A plug-in failed in some images, so the rate would not be that of the decoder.
    """
    settings = RateSettings(images, (decoder,), seed, tolerance, force or {}, path)
    check_rate(scene, settings)
    with Faults().counting() as faults:
        (correct,), _ = count_right_and_whole(scene, settings)
    if str(faults):
        raise PluginError(str(faults))
    return 100.0 * correct / (images * scene.transmitter.payload_length)


def count_right_and_whole(
    scene: Scene, settings: RateSettings, heartbeat: Heartbeat = lambda: None
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Count the correct bits, and the images without a wrong bit, of each decoder."""
    right_bits, whole_images = [0] * len(settings.decoders), [0] * len(settings.decoders)
    length = scene.transmitter.payload_length
    for bits_of_decoders in right_bits_of_images(scene, settings, heartbeat):
        for decoder_index, right in enumerate(bits_of_decoders):
            right_bits[decoder_index] += right
            whole_images[decoder_index] += right == length
    return tuple(right_bits), tuple(whole_images)


def plan_images(scenes: Sequence[Scene], settings: RateSettings) -> Plan:
    """Choose the effects of images that differ only in phase and code."""
    simulation_settings = SimulationSettings(settings.tolerance, "signal", settings.force)
    return signal_plan(
        scenes, simulation_settings, needs_pixels=_span_of_path(scenes[0], settings.path) is None
    )


@lru_cache(maxsize=4)
def _span_of_path(scene: Scene, path: SignalPath) -> Region | None:
    """Return the rectangle that the panel fills; None if pixels must be simulated in any case."""
    return panel_span(scene) if path in ("auto", "profile") else None


def right_bits_of_images(
    scene: Scene,
    settings: RateSettings,
    heartbeat: Heartbeat = lambda: None,
    chosen: Plan | None = None,
) -> Iterator[tuple[int, ...]]:
    """Yield the number of bits that each decoder reads correctly, image by image.

    ``chosen``: the effects to simulate, by default those that the scene's own signal needs.
    """
    sent = np.array(scene.transmitter.payload_bits, dtype=np.uint8)
    force = tuple(sorted(settings.force.items()))
    pictures = _StudyPictures(scene, settings.seed, settings.tolerance, force, settings.path)
    for image in range(settings.images):
        heartbeat()
        observation = (
            _observe_cached(pictures, image)
            if chosen is None
            else observe_picture(pictures, chosen, image)
        )
        results = _read_by_decoders(scene, observation, settings.decoders)
        yield tuple(_count_right_bits(result, sent) for result in results)


@dataclass(frozen=True, slots=True)
class _StudyPictures:
    """All that the pictures of a study depend on, which excludes the decoders."""

    scene: Scene
    seed: int
    tolerance: float
    force: tuple[tuple[str, bool], ...]
    path: SignalPath

    @property
    def settings(self) -> RateSettings:
        return RateSettings(1, (), self.seed, self.tolerance, dict(self.force), self.path)


@lru_cache(maxsize=4)
def _plan_cached(pictures: _StudyPictures) -> Plan:
    """Choose the effects of all pictures, which differ only in phase and noise."""
    return plan_images([pictures.scene], pictures.settings)


@lru_cache(maxsize=_CACHED_PICTURES)
def _observe_cached(pictures: _StudyPictures, image: int) -> Observation | None:
    return observe_picture(pictures, _plan_cached(pictures), image)


def _count_right_bits(result: DecodeResult, sent: ByteArray) -> int:
    """Count the correct bits; 0 if the decoder rejects them, for example as uncertain."""
    if result.failure is not None or result.bits.size != sent.size:
        return 0
    return int(np.count_nonzero(result.bits == sent))


@lru_cache(maxsize=256)
def _seed_of(seed: int, image: int) -> np.random.SeedSequence:
    """Return the seed of an image, a child of ``seed`` that is the same at every point."""
    return np.random.SeedSequence(seed, spawn_key=(image,))


def _read_by_decoders(
    scene: Scene, observation: Observation | None, decoders: Sequence[str]
) -> list[DecodeResult]:
    if observation is None:
        return [DecodeResult(decoder, failure=_NO_PANEL) for decoder in decoders]
    return [observation.read(scene, decoder) for decoder in decoders]


def observe_picture(pictures: _StudyPictures, chosen: Plan, image: int) -> Observation | None:
    """Simulate the signal that a decoder reads from a picture; None if no panel is found in it."""
    scene, path = pictures.scene, pictures.path
    stream = np.random.default_rng(_seed_of(pictures.seed, image))
    transmitter = scene.transmitter
    duration = len(sent_chips(transmitter)) * transmitter.switching_period
    changes = {"start_time": float(stream.uniform(0.0, duration))}
    if scene.surroundings.flicker_depth:  # the mains are not synchronous with the packets
        changes["flicker_phase"] = float(stream.uniform(-math.pi, math.pi))
    view = paper_view_of(scene.replace(**changes))
    return observe(view, _span_of_path(scene, path), chosen, stream, path)


def check_rate(scene: Scene, settings: RateSettings) -> None:
    check_size(scene.camera)
    check_count("images", settings.images, 1, MOST_IMAGES)
    check_seed(settings.seed)
    check_choice("path", settings.path, SIGNAL_PATHS)
    TOLERANCE.check(settings.tolerance)
    check_switches(settings.force, NAMES)
    for decoder in settings.decoders:
        decoder_named(decoder)
    check_code(scene.transmitter)
    if scene.transmitter.pattern:
        raise ParameterError("A raw pattern has no code; a success rate needs packets.")
