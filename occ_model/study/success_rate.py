"""The success rate, as the paper defines it."""

import math
from collections.abc import Mapping
from typing import Literal

import numpy as np

from occ_model.checks import check_choice, check_count, check_seed
from occ_model.effects.plan import plan
from occ_model.errors import ParameterError
from occ_model.receiver.decode import decode
from occ_model.receiver.decoders import PAPERS, decoder_named
from occ_model.results import DecodeResult, Plan
from occ_model.scene import Scene, check_scene
from occ_model.simulation import render
from occ_model.simulation_settings import TOLERANCE
from occ_model.study.observation import decode_profile
from occ_model.transmitter.packet import bits_of, packet_length

Way = Literal["auto", "profile", "image"]

_WAYS: tuple[Way, ...] = ("auto", "profile", "image")

_SEEDS = 2**32


def success_rate(
    scene: Scene,
    images: int = 5,
    decoder: str = PAPERS,
    seed: int = 1,
    *,
    tolerance: float = TOLERANCE.default,
    force: Mapping[str, bool] | None = None,
    path: Way = "auto",
) -> float:
    """Give the share of bits read rightly over several images, in percent.

    SR = correct bits / (images x bits) x 100, the paper's definition. The images differ in start
    time, evenly distributed over one packet, and in noise. An image in which no bits are read
    counts with none right. Which effects they show is planned for what a decoder sees, the profile.

    Parameters
    ----------
    scene
        The scene; its start time and its flicker's phase are not used.
    images
        How many.
    decoder
        The decoder's name.
    seed
        Of the start times and the noise: the same seed gives the same rate.
    tolerance, force
        As for :func:`occ_model.plan`.
    path
        ``"image"``: make every image whole. ``"profile"``: decode the column means that it would
        have, which needs rows that differ by noise at most: a level panel, and no image effect in
        the plan. ``"auto"``: the profile wherever that holds.

    Returns
    -------
    float
        Percent.

    Raises
    ------
    ParameterError
        There are no images, no such decoder, path or effect, seed or tolerance are out of range,
        the scene sends a raw pattern, or ``path`` is ``"profile"`` and rows differ.
    ProjectionError
        The scene has no picture.
    """
    _check(scene, images, decoder, seed, path)
    transmitter = scene.transmitter
    sent = np.array(bits_of(transmitter.code, transmitter.bits))
    duration = packet_length(transmitter.bits) * transmitter.switching_period
    correct = 0
    root = np.random.default_rng(seed)
    for _ in range(images):
        (stream,) = root.spawn(1)
        at = scene.replace(start_time=float(stream.uniform(0.0, duration)))
        if scene.surroundings.flicker_depth:  # the mains keep no time with the packets
            at = at.replace(flicker_phase=float(stream.uniform(-math.pi, math.pi)))
        chosen = plan(at, tolerance, "profile", force)
        seen = _decode(at, decoder, chosen, path, stream)
        if seen.bits.size == sent.size:
            correct += int(np.count_nonzero(seen.bits == sent))
    return 100.0 * correct / (images * sent.size)


def _decode(
    scene: Scene, decoder: str, chosen: Plan, path: Way, random: np.random.Generator
) -> DecodeResult:
    if path != "image":
        result = decode_profile(scene, decoder, chosen, random)
        if result is not None:
            return result
        if path == "profile":
            raise ParameterError(
                "path is 'profile'; a panel that is not level, or an image effect, needs 'image'."
            )
    force = {decision.effect: decision.included for decision in chosen.decisions}
    frame = render(scene, seed=int(random.integers(_SEEDS)), force=force)
    return decode(frame.image, scene, decoder)


def _check(scene: Scene, images: int, decoder: str, seed: int, path: Way) -> None:
    check_scene(scene)
    check_count("images", images, 1)
    check_seed(seed)
    check_choice("path", path, _WAYS)
    decoder_named(decoder)
    if scene.transmitter.pattern:
        raise ParameterError("A raw pattern holds no code; a success rate needs packets.")
