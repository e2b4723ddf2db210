"""Parameters of three lights and of a colour camera; none matters while ``bayer`` is none."""

import math
from dataclasses import dataclass

from occ_model.scene.parameters.group import (
    Group,
    choice_field,
    count_field,
    quantity_field,
    text_field,
)
from occ_model.scene.parameters.light import MAX_BITS
from occ_model.scene.units import NONE, PERCENT

COLOURS = ("red", "green", "blue")

CSK_ORDERS = {"4-csk": 4, "8-csk": 8, "16-csk": 16}

_LEAST_SENSITIVITY = 0.01  # to white, of a channel

_MATRIX = (
    "nothing, or nine numbers from 0 to 1, three for each channel, "
    f"whose sum is {_LEAST_SENSITIVITY:g} or more"
)


def _canonical_matrix(text: str) -> str:
    """Return nine numbers in one form; ValueError with the problem."""
    words = text.replace(",", " ").replace(";", " ").replace("/", " ").split()
    if not words:
        return ""
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        raise ValueError("has a word that is not a number") from None
    if len(numbers) != 9:
        raise ValueError(f"has {len(numbers)} numbers")
    if not all(math.isfinite(number) and 0.0 <= number <= 1.0 for number in numbers):
        raise ValueError("has a number outside 0 to 1")
    rows = [numbers[first : first + 3] for first in (0, 3, 6)]
    if not all(sum(row) >= _LEAST_SENSITIVITY for row in rows):
        raise ValueError("has a channel that sees hardly any light")
    if abs(_determinant(rows)) < 1e-6:
        raise ValueError("cannot be inverted")
    return " / ".join(" ".join(f"{number:g}" for number in row) for row in rows)


def _determinant(rows: list[list[float]]) -> float:
    """Return the determinant of a matrix whose rows are divided by their sums."""
    (a, b, c), (d, e, f), (g, h, i) = ([number / sum(row) for number in row] for row in rows)
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


@dataclass(frozen=True, kw_only=True)
class Colours(Group):
    # fmt: off
    bayer: str = choice_field(
        "Bayer pattern", "",
        "Filters of the first two pixels of the first two rows; none: a monochrome camera.",
        ("none", "rggb", "grbg", "gbrg", "bggr"), "none",
    )
    colour_light: str = choice_field(
        "Coloured light", "",
        "All three LEDs alike; three codes at once; one LED alone on steady light of the others; "
        "or colour shift keying.",
        ("white", "three-codes", *COLOURS, *CSK_ORDERS), "white",
    )
    green_code: int = count_field(
        "Green LED's code", "", "Of three codes, the green LED's; the red one sends the code.",
        0, 2**MAX_BITS - 1, 345,
    )
    blue_code: int = count_field(
        "Blue LED's code", "", "Of three codes, the blue LED's.", 0, 2**MAX_BITS - 1, 201,
    )
    crosstalk: float = quantity_field(
        "Crosstalk", "c",
        "Fraction of a channel's light that comes from the other two LEDs, half from each.",
        unit=PERCENT, low=0.0, high=0.6, slider=(0.0, 0.6), scale="linear", default=0.0,
    )
    mixing: str = text_field(
        "Mixing matrix", "M",
        "Light of the red, green and blue LED in the red, then green, then blue channel.",
        "", _MATRIX, _canonical_matrix, empty="by the crosstalk",
    )
    red_gain: float = quantity_field(
        "White balance, red", "", "Gain of the red channel against the green one.",
        unit=NONE, low=0.25, high=8.0, slider=(0.5, 4.0), scale="log", default=1.0,
    )
    blue_gain: float = quantity_field(
        "White balance, blue", "", "Gain of the blue channel against the green one.",
        unit=NONE, low=0.25, high=8.0, slider=(0.5, 4.0), scale="log", default=1.0,
    )
    demosaicing: str = choice_field(
        "Demosaicing", "",
        "How each pixel gets the two colours that it did not see; none: the raw mosaic is kept.",
        ("bilinear", "vng", "edge-aware", "none"), "bilinear",
    )
    chroma: str = choice_field(
        "JPEG chroma", "",
        "Colours of a JPEG file: one value for four pixels (4:2:0), or one for each (4:4:4).",
        ("subsampled", "full"), "subsampled",
    )
    shown_colour: str = choice_field(
        "Shown colour", "",
        "The LED and the pixels that profiles, decoders and studies of one colour are about.",
        COLOURS, "green",
    )
    # fmt: on

    @property
    def codes(self) -> dict[str, int]:
        """The codes of the green and the blue LED, by their parameters' names."""
        return {"green_code": self.green_code, "blue_code": self.blue_code}

    @property
    def matrix(self) -> tuple[tuple[float, float, float], ...]:
        """The mixing matrix M: a row for each channel, a column for each LED."""
        if self.mixing:
            numbers = [float(word) for word in self.mixing.replace("/", " ").split()]
            return tuple((numbers[i], numbers[i + 1], numbers[i + 2]) for i in (0, 3, 6))
        own, other = 1.0 - self.crosstalk, self.crosstalk / 2.0
        return (own, other, other), (other, own, other), (other, other, own)

    @property
    def mixes(self) -> bool:
        """Whether any channel sees the light of another LED."""
        return any(self.matrix[c][k] for c in range(3) for k in range(3) if c != k)

    @property
    def gains(self) -> tuple[float, float, float]:
        """The gain of each channel by the white balance."""
        return self.red_gain, 1.0, self.blue_gain

    @property
    def filters(self) -> tuple[tuple[int, tuple[slice, slice]], ...]:
        """The channel of each of the pattern's four places, and its rows and columns."""
        return tuple(
            ("rgb".index(letter), (slice(place // 2, None, 2), slice(place % 2, None, 2)))
            for place, letter in enumerate(self.bayer)
        )

    def first_pixel(self, colour: str) -> tuple[int, int]:
        """Return row and column of the colour's first pixel: of green, in the first row."""
        place = self.bayer.index(colour[0])
        return place // 2, place % 2
