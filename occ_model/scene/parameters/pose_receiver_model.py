"""Parameters of the pose, the receiver and the model."""

import math

from occ_model.scene.parameter_kinds import Choice, Parameter, Quantity
from occ_model.scene.units import METRE, NONE, RADIAN, SECOND

_STEEP = math.radians(89.99)
_TILT = math.radians(60.0)

# fmt: off
POSE: tuple[Parameter, ...] = (
    Quantity(
        "distance",
        "Distance",
        "d",
        "Distance from the camera to the panel's centre, along the optical axis.",
        unit=METRE, low=1e-3, high=1e4, slider=(0.2, 5.0), scale="log", default=1.2,
    ),
    Quantity(
        "offset_x",
        "Offset along columns",
        "",
        "Shift of the panel's centre along the columns axis.",
        unit=METRE, low=-1e4, high=1e4, slider=(-1.0, 1.0), scale="linear", default=0.0,
    ),
    Quantity(
        "offset_y",
        "Offset along rows",
        "",
        "Shift of the panel's centre along the rows axis.",
        unit=METRE, low=-1e4, high=1e4, slider=(-1.0, 1.0), scale="linear", default=0.0,
    ),
    Quantity(
        "yaw",
        "Yaw",
        "",
        "Turn of the panel about the rows axis.",
        unit=RADIAN, low=-_STEEP, high=_STEEP, slider=(-_TILT, _TILT), scale="linear", default=0.0,
    ),
    Quantity(
        "pitch",
        "Pitch",
        "",
        "Turn of the panel about the columns axis.",
        unit=RADIAN, low=-_STEEP, high=_STEEP, slider=(-_TILT, _TILT), scale="linear", default=0.0,
    ),
    Quantity(
        "roll",
        "Roll",
        "",
        "Turn of the panel about the optical axis.",
        unit=RADIAN, low=-math.pi, high=math.pi,
        slider=(-_TILT, _TILT), scale="linear", default=0.0,
    ),
)

RECEIVER: tuple[Parameter, ...] = (
    Quantity(
        "bright_fraction",
        "Brightest pixels",
        "",
        "Share of the image's pixels, the brightest, that mark the panel for the decoder.",
        unit=NONE, low=1e-4, high=0.5, slider=(0.01, 0.2), scale="log", default=0.05,
    ),
    Choice(
        "equalizer",
        "Equalizer",
        "",
        "How the equalizer undoes the exposure: with the least error, or as if without noise.",
        ("mmse", "zero-forcing"),
        "mmse",
    ),
)

MODEL: tuple[Parameter, ...] = (
    Quantity(
        "start_time",
        "Start time",
        "t_0",
        "When the first column's exposure starts, counted from the start of a packet.",
        unit=SECOND, low=-1e9, high=1e9, slider=(0.0, 0.02), scale="linear", default=0.0,
    ),
    Choice(
        "averaging",
        "Averaging",
        "",
        "What a column averages: pixel values, as the paper does, or light, as a sensor does.",
        ("pixel-value", "light"),
        "pixel-value",
    ),
    Choice(
        "enhancement",
        "Contrast enhancement",
        "",
        "What is done to the column values: histogram equalization (the paper), stretch, none.",
        ("equalization", "stretch", "none"),
        "equalization",
    ),
    Choice(
        "band_reading",
        "Band model",
        "",
        "Bands with exact run lengths, or whole columns for each chip and each change (literal).",
        ("aligned", "literal"),
        "aligned",
    ),
)
# fmt: on
