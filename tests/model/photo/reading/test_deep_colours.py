"""Colours of 16 bits are put together exactly, and what is transparent is black."""

import numpy as np
from PIL import Image

from occ_model.photo.reading.image_decoding import _deep_colours

RANDOM = np.random.default_rng(5)


def halves(deep: np.ndarray) -> tuple[Image.Image, Image.Image]:
    """Split colours into pictures of their upper and of their lower bytes."""
    upper, lower = (deep >> 8).astype(np.uint8), (deep & 255).astype(np.uint8)
    return Image.fromarray(upper), Image.fromarray(lower)


def test_both_bytes_of_a_colour_count() -> None:
    deep = RANDOM.integers(0, 65536, (5, 7, 3)).astype(np.uint16)
    assert _deep_colours(*halves(deep)).tolist() == deep.tolist()


def test_the_colour_that_is_called_transparent_is_black_and_no_other() -> None:
    deep = RANDOM.integers(1, 65536, (5, 7, 3)).astype(np.uint16)
    deep[2, 3] = deep[4, 4] = (700, 800, 900)
    deep[0, 0] = (700, 800, 901)
    upper, lower = halves(deep)
    upper.info["transparency"] = (700, 800, 900)
    expected = deep.copy()
    expected[2, 3] = expected[4, 4] = 0
    assert _deep_colours(upper, lower).tolist() == expected.tolist()


def test_what_is_partly_transparent_is_as_much_darker_rounded_to_the_nearest() -> None:
    deep = RANDOM.integers(0, 65536, (50, 70, 4)).astype(np.uint16)
    expected = np.rint(deep[..., :3].astype(float) * deep[..., 3:] / 65535.0)
    assert _deep_colours(*halves(deep)).tolist() == expected.tolist()
    deep[..., 3] = 65535
    assert _deep_colours(*halves(deep)).tolist() == deep[..., :3].tolist()
