"""Measure the success rate: the fraction of bits read correctly over several images."""

from collections import OrderedDict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice
from typing import TypeVar

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.camera.projection import check_size
from occ_model.effects.plan import signal_plan
from occ_model.effects.registry import NAMES
from occ_model.errors import ParameterError, PluginError
from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.receiver.decode import decode_profiles, decoder_named
from occ_model.results.decoding import PAPER_DECODER, DecodeResult
from occ_model.results.frame import Plan
from occ_model.results.sweep_request import MOST_IMAGES, SIGNAL_PATHS, RateSettings, SignalPath
from occ_model.scene.argument_checks import check_choice, check_count, check_seed, check_switches
from occ_model.scene.scene import TOLERANCE, Scene, SimulationSettings
from occ_model.study.signals.batch import Observation
from occ_model.study.signals.pictures import image_of, observe_images
from occ_model.transmitter.scheme import check_code

_Item = TypeVar("_Item")

_MOST_KEPT = 3000
"""Pictures whose signals are kept for the next decoder, enough for the searches of limits."""
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
    whose bits the decoder rejects, counts as having none correct. The column means that a decoder
    reads are computed without pixels, for many images at once, with all effects of the scene:
    planning would take longer than all effects do.

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
        ``"image"``: simulate every image as a whole, with the effects planned for the signal.
        ``"auto"``, ``"profile"``, ``"rows"``: without pixels.

    Returns
    -------
    float
        Percent.

    Raises
    ------
    ParameterError
        An argument is not allowed, or no code is sent.
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
    scene: Scene, settings: RateSettings, heartbeat: Heartbeat = lambda: None, first: int = 0
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Count the correct bits, and the images without a wrong bit, of each decoder.

    ``first``: number of the first image.
    """
    right_bits, whole_images = [0] * len(settings.decoders), [0] * len(settings.decoders)
    length = scene.transmitter.payload_length
    images = right_bits_of_images(scene, settings, heartbeat, at_once=_MOST_AT_ONCE, first=first)
    for bits_of_decoders in images:
        for decoder_index, right in enumerate(bits_of_decoders):
            right_bits[decoder_index] += right
            whole_images[decoder_index] += right == length
    return tuple(right_bits), tuple(whole_images)


def plan_images(scenes: Sequence[Scene], settings: RateSettings) -> Plan:
    """Choose the effects of images that differ only in phase and code."""
    simulation_settings = SimulationSettings(settings.tolerance, "signal", settings.force)
    return signal_plan(scenes, simulation_settings, is_estimated=settings.path == "image")


_MOST_AT_ONCE = 40  # images that are simulated and read at once


def right_bits_of_images(
    scene: Scene,
    settings: RateSettings,
    heartbeat: Heartbeat = lambda: None,
    at_once: int = 1,
    first: int = 0,
) -> Iterator[tuple[int, ...]]:
    """Yield the number of bits that each decoder reads correctly, image by image.

    ``at_once``: images that are read first, more if more are asked for. ``first``: number of the
    first image.
    """
    check_size(scene.camera)
    pictures = _pictures_of(scene, settings)
    numbers = range(first, settings.images)
    for part in _batches(numbers, 1 if settings.path == "image" else at_once, settings.path):
        observations = _observe_cached([(pictures, number) for number in part])
        yield from _right_bits([scene] * len(part), observations, settings, heartbeat)


def right_bits_of_scenes(
    scenes: Iterable[tuple[Scene, int]],
    settings: RateSettings,
    heartbeat: Heartbeat = lambda: None,
    chosen: Plan | None = None,
) -> Iterator[tuple[int, ...]]:
    """Yield the number of bits that each decoder reads correctly in one picture of each scene.

    ``scenes``: each with the seed of its picture. ``chosen``: the effects to simulate, by default
    those that each scene's signal needs.
    """
    for part in _batches(scenes, 1, settings.path):
        images = [
            image_of(scene, chosen or plan_images([scene], settings), seed, 0)
            for scene, seed in part
        ]
        observations = list(observe_images(images, settings.path))
        yield from _right_bits([scene for scene, _ in part], observations, settings, heartbeat)


def _batches(items: Iterable[_Item], count: int, path: SignalPath) -> Iterator[list[_Item]]:
    """Yield items that are read at once: few at first, as not all may be asked for."""
    remaining = iter(items)
    while part := list(islice(remaining, count)):
        yield part
        if path != "image":
            count = min(4 * count, _MOST_AT_ONCE)


def simulate_ahead(scenes: Sequence[Scene], settings: RateSettings, first: int, last: int) -> None:
    """Simulate some images of several scenes at once, for decoders that will read them."""
    if settings.path != "image":
        pictures = (_pictures_of(scene, settings) for scene in scenes)
        _observe_cached([(each, number) for each in pictures for number in range(first, last)])


@dataclass(frozen=True, slots=True)
class ImageSeries:
    """Some images of a scene, by their numbers, in a study of its own seed."""

    scene: Scene
    seed: int
    numbers: range


def read_ahead(
    series: Sequence[ImageSeries],
    settings: RateSettings,
    heartbeat: Heartbeat,
) -> Iterator[list[int]]:
    """Yield how many bits a decoder reads correctly in the images of each series.

    The images of several series are simulated and read at once.
    """
    remaining = iter(series)
    for first in remaining:
        at_once = max(_MOST_AT_ONCE // len(first.numbers), 1)
        part = [first, *islice(remaining, at_once - 1)]
        keys = [
            (_pictures_of(each.scene, replace(settings, seed=each.seed)), number)
            for each in part
            for number in each.numbers
        ]
        scenes = [pictures.scene for pictures, _ in keys]
        right_bits = _right_bits(scenes, _observe_cached(keys), settings, heartbeat)
        for each in part:
            yield [right for (right,) in islice(right_bits, len(each.numbers))]


def _right_bits(
    scenes: Sequence[Scene],
    observations: Sequence[Observation | None],
    settings: RateSettings,
    heartbeat: Heartbeat,
) -> Iterator[tuple[int, ...]]:
    """Read pictures, each of its own scene, at once; yield each one's correct bits by decoder."""
    results = [_read(scenes, observations, decoder) for decoder in settings.decoders]
    for scene, *of_picture in zip(scenes, *results, strict=True):
        heartbeat()
        sent = np.array(scene.transmitter.payload_bits, dtype=np.uint8)
        yield tuple(_count_right_bits(result, sent) for result in of_picture)


def _pictures_of(scene: Scene, settings: RateSettings) -> "_StudyPictures":
    force = tuple(sorted(settings.force.items()))
    return _StudyPictures(scene, settings.seed, settings.tolerance, force, settings.path)


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


@lru_cache(maxsize=256)
def _plan_cached(pictures: _StudyPictures) -> Plan:
    """Choose the effects of all pictures, which differ only in phase and noise."""
    return plan_images([pictures.scene], pictures.settings)


_observed: OrderedDict[tuple[_StudyPictures, int], Observation | None] = OrderedDict()


def _observe_cached(
    keys: Sequence[tuple[_StudyPictures, int]],
) -> list[Observation | None]:
    """Return the signals of pictures, simulated at once if they are not kept from before."""
    found = {key: _observed[key] for key in keys if key in _observed}
    missing = [key for key in keys if key not in found]
    images = [
        image_of(pictures.scene, _plan_cached(pictures), pictures.seed, number)
        for pictures, number in missing
    ]
    path = keys[0][0].path if keys else "auto"
    found |= zip(missing, observe_images(images, path), strict=True)
    for key in missing:
        _observed[key] = found[key]
        if len(_observed) > _MOST_KEPT:
            _observed.popitem(last=False)
    return [found[key] for key in keys]


def _count_right_bits(result: DecodeResult, sent: ByteArray) -> int:
    """Count the correct bits; 0 if the decoder rejects them, for example as uncertain."""
    if result.failure is not None or result.bits.size != sent.size:
        return 0
    return int(np.count_nonzero(result.bits == sent))


def _read(
    scenes: Sequence[Scene], observations: Sequence[Observation | None], decoder: str
) -> list[DecodeResult]:
    """Read the pictures that show a panel, all at once."""
    shown = [
        (each.signal, scene)
        for each, scene in zip(observations, scenes, strict=True)
        if each is not None
    ]
    read = iter(decode_profiles([one for one, _ in shown], [one for _, one in shown], decoder))
    unread = DecodeResult(decoder, failure=_NO_PANEL)
    return [unread if each is None else next(read) for each in observations]


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
