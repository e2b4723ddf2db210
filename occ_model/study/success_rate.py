"""The success rate, as the paper defines it."""

from typing import Literal

import numpy as np

from occ_model.camera.photometry import WHITE
from occ_model.checks import check_count, check_level, check_seed
from occ_model.errors import ParameterError
from occ_model.receiver.decode import decode
from occ_model.receiver.decoders import PAPERS, decoder_named
from occ_model.results import DecodeResult
from occ_model.scene import Scene
from occ_model.study.observation import decode_profile, noisy_image
from occ_model.transmitter.packet import bits_of, packet_length

PIXEL_NOISE = 1.0
"""Standard deviation of a pixel's noise in grey levels, before enhancement."""

Way = Literal["auto", "profile", "image"]


def success_rate(
    scene: Scene,
    images: int = 5,
    decoder: str = PAPERS,
    seed: int = 1,
    *,
    noise: float = PIXEL_NOISE,
    path: Way = "auto",
) -> float:
    """Give the share of bits read rightly over several images, in percent.

    SR = correct bits / (images x bits) x 100, the paper's definition. The images differ in start
    time, evenly distributed over one packet, and in noise. An image in which no bits are read
    counts with none right.

    Parameters
    ----------
    scene
        The scene; its start time is not used.
    images
        How many.
    decoder
        The decoder's name.
    seed
        Of the start times and the noise: the same seed gives the same rate.
    noise
        Standard deviation of a pixel's noise in grey levels, before enhancement.
    path
        ``"image"``: make every image whole. ``"profile"``: decode the column means that it would
        have, which needs the panel to be level. ``"auto"``: the profile where the panel is level.

    Returns
    -------
    float
        Percent.

    Raises
    ------
    ParameterError
        There are no images, no such decoder or path, seed or noise are out of range, the scene
        sends a raw pattern, or it is not level and ``path`` is ``"profile"``.
    ProjectionError
        The scene has no picture.
    """
    _check(scene, images, decoder, seed, noise, path)
    transmitter = scene.transmitter
    sent = np.array(bits_of(transmitter.code, transmitter.bits))
    duration = packet_length(transmitter.bits) * transmitter.switching_period
    correct = 0
    root = np.random.default_rng(seed)
    for _ in range(images):
        (stream,) = root.spawn(1)
        start_time = float(stream.uniform(0.0, duration))
        seen = _decode(scene.replace(start_time=start_time), decoder, noise, path, stream)
        if seen.bits.size == sent.size:
            correct += int(np.count_nonzero(seen.bits == sent))
    return 100.0 * correct / (images * sent.size)


def _decode(
    scene: Scene, decoder: str, noise: float, path: Way, random: np.random.Generator
) -> DecodeResult:
    if path != "image":
        result = decode_profile(scene, decoder, noise, random)
        if result is not None:
            return result
        if path == "profile":
            raise ParameterError("path is 'profile'; a panel that is not level needs 'image'.")
    return decode(noisy_image(scene, noise, random), scene, decoder)


def _check(scene: Scene, images: int, decoder: str, seed: int, noise: float, path: Way) -> None:
    check_count("images", images, 1)
    check_seed(seed)
    check_level("noise", noise, WHITE)
    decoder_named(decoder)
    if path not in ("auto", "profile", "image"):
        raise ParameterError(f"path is {path!r}; allowed: auto, profile, image.")
    if scene.transmitter.pattern:
        raise ParameterError("A raw pattern holds no code; a success rate needs packets.")
