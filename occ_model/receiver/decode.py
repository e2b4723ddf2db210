"""Decode an image or a profile with a built-in decoder, or a plug-in's, whose result is checked."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model import plugins
from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.camera.pixel_arrays import bytes_of, check_pixels
from occ_model.camera.projection import MAX_PIXELS
from occ_model.errors import DecodeInputError, ParameterError, PluginError, quote
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.equalizer import DECODER as EQUALIZER
from occ_model.receiver.matched.decoder import DECODER as MATCHED
from occ_model.receiver.result_check import check_result
from occ_model.receiver.signal import column_means, locate
from occ_model.receiver.threshold import DECODER as THRESHOLD
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, Region
from occ_model.scene.colour_scenes import check_monochrome
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import check_code


def _read_sequences(signals: Sequence[FloatArray], scenes: Sequence[Scene]) -> list[DecodeResult]:
    # Imported when first needed, because most signals are read without it.
    from occ_model.receiver.sequence.decoder import read_signals

    return read_signals(signals, scenes)


SEQUENCE = Decoder(
    "sequence",
    "Sequence: the most likely chips",
    lambda signal, scene: _read_sequences([signal], [scene])[0],
    _read_sequences,
    is_quick=False,
    # A picture takes 0.02 s up to 7 chips, 0.1 s at 10 chips and several seconds at 14.
    searched_chips=8.0,
)

DECODERS: dict[str, Decoder] = {  # the built-in decoders by name
    decoder.name: decoder for decoder in (THRESHOLD, MATCHED, EQUALIZER, SEQUENCE)
}


def decoders() -> tuple[str, ...]:
    """Return the names of all decoders, with those of plug-ins last."""
    return tuple(dict.fromkeys((*DECODERS, *plugins.plugin_names(plugins.DECODERS))))


QUICK_DECODERS = tuple(name for name, decoder in DECODERS.items() if decoder.is_quick)
"""Names of the decoders that read every picture of the window."""


def decoder_named(name: str) -> Decoder:
    if isinstance(name, str):
        if name in DECODERS:
            return DECODERS[name]
        if name in decoders():
            return _load_plugin(name)
    raise ParameterError.of("decoder", quote(name), ", ".join(decoders()))


def read_with(decoder: str, signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read a signal with a named decoder; a plug-in's fault becomes the result's failure.

    A light that is no code is also a failure, as anything read from it was not sent.
    """
    return _read_all(decoder, [signal], [scene])[0]


def _read_all(
    decoder: str, signals: Sequence[FloatArray], scenes: Sequence[Scene]
) -> list[DecodeResult]:
    """Read each signal as :func:`read_with`, together where the decoder reads many faster."""
    method = decoder_named(decoder)
    refusals = [_explain_light(scene) for scene in scenes]
    codes = [place for place, refusal in enumerate(refusals) if refusal is None]
    results = [
        DecodeResult(decoder, signal=signal, failure=refusal)
        for signal, refusal in zip(signals, refusals, strict=True)
    ]
    if method.read_many is not None and len(codes) > 1:
        read = method.read_many([signals[one] for one in codes], [scenes[one] for one in codes])
    else:
        read = [_read_one(method, signals[one], scenes[one]) for one in codes]
    for place, result in zip(codes, read, strict=True):
        results[place] = result
    return results


def _explain_light(scene: Scene) -> str | None:
    try:
        check_code(scene.transmitter)
    except ParameterError as refusal:
        return str(refusal)
    return None


def _read_one(decoder: Decoder, signal: FloatArray, scene: Scene) -> DecodeResult:
    try:
        result = decoder.read(signal, scene)
    except PluginError as fault:
        plugins.note_reading(decoder.name, str(fault))
        return DecodeResult(decoder.name, signal=signal, failure=str(fault))
    plugins.note_reading(decoder.name, None)
    return result


@lru_cache(maxsize=64)
def _load_plugin(name: str) -> Decoder:
    """Import a plug-in's decoder, whose faults become sentences."""
    decoder = plugins.load_plugin(plugins.DECODERS, name, Decoder)
    who = plugins.describe(plugins.DECODERS, name)

    def read(signal: FloatArray, scene: Scene) -> DecodeResult:
        def check(result: object) -> DecodeResult:
            checked = plugins.of_kind(who, DecodeResult)(result)
            return replace(check_result(who, checked, len(signal), scene), decoder=name)

        try:
            # A copy, because other decoders read the signal afterwards.
            return plugins.call(who, "read", check, decoder.read, np.array(signal), scene)
        except ParameterError as error:
            raise PluginError(str(error), parameters=error.parameters) from None

    return Decoder(name, decoder.title, read)


_LARGEST_LEVEL = 1e5  # largest accepted grey level, above those of any bit depth


def decode(image: NDArray[Any], scene: Scene, decoder: str = PAPER_DECODER) -> DecodeResult:
    """Read the code that an image shows.

    Parameters
    ----------
    image : ndarray, shape (rows, columns) or (columns,)
        A grey image with the columns as scan axis: uint8, uint16 (65535 is white) or floating
        point. Floating-point pixels are fractions of white if none exceeds 1, and grey levels if
        the largest exceeds 2 and none exceeds 255; others are refused. An array of one dimension is
        a profile in grey levels, with any gain and offset, in which no panel is located.
    scene
        The parameters that the receiver knows.
    decoder
        A name from ``DECODERS``.

    Returns
    -------
    DecodeResult
        Its ``failure`` is a sentence on why there is no code.

    Raises
    ------
    DecodeInputError
        The array is not a grey image or profile, is empty or too large, contains a value that is
        not a number, or does not show which value is white.
    ParameterError
        The decoder does not exist.
    PluginError
        The decoder is a plug-in that cannot be imported; if it fails later, ``failure`` names it.
    """
    check_monochrome(scene)
    decoder_named(decoder)
    try:
        image = np.asarray(image)
    except ValueError:
        raise DecodeInputError(
            "The image is not an array: its rows have different lengths."
        ) from None
    _check_shape(image)
    if image.ndim == 1:
        return decode_profiles([image], [scene], decoder)[0]
    grey = bytes_of(image)
    location = locate(grey, scene.receiver.bright_fraction)
    if location is None:
        return DecodeResult(
            decoder, failure=f"No panel found: every pixel has the grey level {grey.flat[0]}."
        )
    result = read_with(decoder, column_means(grey, location.region), scene)
    return replace(result, region=location.region, location=location)


def decode_profiles(
    profiles: Sequence[NDArray[Any]], scenes: Sequence[Scene], decoder: str = PAPER_DECODER
) -> list[DecodeResult]:
    """Read the codes that several profiles show, each exactly as :func:`decode` reads it alone.

    Parameters
    ----------
    profiles : sequence of ndarray, each of shape (columns,)
        Grey levels with any gain and offset; their lengths may differ.
    scenes
        The parameters that the receiver knows, one scene for each profile.
    decoder
        A name from ``DECODERS``.

    Returns
    -------
    list of DecodeResult
        In the order of the profiles.

    Raises
    ------
    DecodeInputError
        A profile is empty or contains a value that is not a number.
    ParameterError
        The decoder does not exist.
    PluginError
        The decoder is a plug-in that cannot be imported; if it fails later, ``failure`` names it.
    """
    levels = [_convert_to_levels(check_pixels(profile)) for profile in profiles]
    results = []
    for profile, signal, result in zip(
        profiles, levels, _read_all(decoder, levels, scenes), strict=True
    ):
        read = replace(result, region=Region(0, 1, 0, len(signal)))
        results.append(_with_hint(read, signal) if profile.dtype.kind == "f" else read)
    return results


def _convert_to_levels(profile: NDArray[Any]) -> FloatArray:
    """Convert a profile of any type to grey levels."""
    levels = profile.astype(np.float64)
    if profile.dtype == np.uint16:
        return levels / 257.0
    largest = float(np.abs(levels).max())
    if largest > _LARGEST_LEVEL:
        raise DecodeInputError(
            f"The profile contains the value {largest:.3g}; grey levels are from 0 to {WHITE:.0f}."
        )
    return levels


def _with_hint(result: DecodeResult, levels: FloatArray) -> DecodeResult:
    """Add to a failure how to scale a profile that may be in fractions of white."""
    if result.failure is None or not 0.0 < np.abs(levels).max() <= 1.0:
        return result
    hint = (
        "A profile must be in grey levels: if this one is in fractions of white, multiply it by "
        "255."
    )
    return replace(result, failure=f"{result.failure} {hint}")


def _check_shape(image: NDArray[Any]) -> None:
    if image.ndim not in (1, 2):
        raise DecodeInputError(
            "A decoder reads a grey image (rows, columns) or a profile (columns,), not an array of "
            f"shape {image.shape}."
        )
    if image.size > MAX_PIXELS:
        raise DecodeInputError(
            f"The image has {image.size / 1e6:.0f} million pixels; "
            f"allowed: up to {MAX_PIXELS // 1_000_000} million."
        )
