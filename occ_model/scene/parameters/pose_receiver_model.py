"""Parameters of the pose, the receiver and the model."""

import math
from dataclasses import dataclass

from occ_model.scene.parameters.group import (
    Group,
    choice_field,
    quantity_field,
)
from occ_model.scene.units import METRE, NONE, RADIAN, SECOND

_LARGEST_ANGLE = math.radians(89.99)
_SLIDER_ANGLE = math.radians(60.0)


@dataclass(frozen=True, kw_only=True)
class Pose(Group):
    """The panel's position and rotation as seen by the camera."""

    # fmt: off
    distance: float = quantity_field(
        "Distance", "d", "Distance from the camera to the panel's centre, along the optical axis.",
        unit=METRE, low=1e-3, high=1e4, slider=(0.2, 5.0), scale="log", default=1.2,
    )
    offset_x: float = quantity_field(
        "Offset along columns", "", "Shift of the panel's centre along the columns axis.",
        unit=METRE, low=-1e4, high=1e4, slider=(-1.0, 1.0), scale="linear", default=0.0,
    )
    offset_y: float = quantity_field(
        "Offset along rows", "", "Shift of the panel's centre along the rows axis.",
        unit=METRE, low=-1e4, high=1e4, slider=(-1.0, 1.0), scale="linear", default=0.0,
    )
    yaw: float = quantity_field(
        "Yaw", "", "Turn of the panel about the rows axis.",
        unit=RADIAN, low=-_LARGEST_ANGLE, high=_LARGEST_ANGLE,
        slider=(-_SLIDER_ANGLE, _SLIDER_ANGLE), scale="linear", default=0.0,
    )
    pitch: float = quantity_field(
        "Pitch", "", "Turn of the panel about the columns axis.",
        unit=RADIAN, low=-_LARGEST_ANGLE, high=_LARGEST_ANGLE,
        slider=(-_SLIDER_ANGLE, _SLIDER_ANGLE), scale="linear", default=0.0,
    )
    roll: float = quantity_field(
        "Roll", "", "Turn of the panel about the optical axis.",
        unit=RADIAN, low=-math.pi, high=math.pi,
        slider=(-_SLIDER_ANGLE, _SLIDER_ANGLE), scale="linear", default=0.0,
    )
    # fmt: on


@dataclass(frozen=True, kw_only=True)
class Receiver(Group):
    # fmt: off
    bright_fraction: float = quantity_field(
        "Brightest pixels", "",
        "Fraction of the image's pixels, the brightest, by which the decoder finds the panel.",
        unit=NONE, low=1e-4, high=0.5, slider=(0.01, 0.2), scale="log", default=0.05,
    )
    equalizer: str = choice_field(
        "Equalizer", "",
        "How the equalizer undoes the exposure: with the least error, or neglecting noise.",
        ("mmse", "zero-forcing"), "mmse",
    )
    # fmt: on


@dataclass(frozen=True, kw_only=True)
class Model(Group):
    """The start time, and the choices between variants of the model."""

    # fmt: off
    start_time: float = quantity_field(
        "Start time", "t_0",
        "When the first column's exposure starts, counted from the start of a packet.",
        unit=SECOND, low=-1e9, high=1e9, slider=(0.0, 0.02), scale="linear", default=0.0,
    )
    averaging: str = choice_field(
        "Averaging", "",
        "What a column averages: pixel values, as the paper does, or light, as a sensor does.",
        ("pixel-value", "light"), "pixel-value",
    )
    enhancement: str = choice_field(
        "Contrast enhancement", "",
        "How column values are enhanced: by histogram equalization (the paper), linearly, or not.",
        ("equalization", "stretch", "none"), "equalization",
    )
    band_reading: str = choice_field(
        "Band model", "",
        "Bands with exact run lengths, or whole columns for each chip and each change (literal).",
        ("aligned", "literal"), "aligned",
    )
    # fmt: on
