"""Every parameter of a scene, declared once.

Sliders, number fields, tooltips, command-line settings, validation, the keys of a scene file and
the README's table are all made from these declarations. Values are in SI units.
"""

import math
from collections.abc import Iterable
from difflib import get_close_matches

from occ_model.declarations import ChipPattern, Choice, Count, Parameter, Quantity
from occ_model.errors import ParameterError
from occ_model.units import (
    ELECTRON,
    HERTZ,
    LUX,
    METRE,
    NIT,
    NONE,
    PIXEL,
    RADIAN,
    SECOND,
)

MAX_BITS = 16

_STEEP = math.radians(89.99)
_TILT = math.radians(60.0)

# fmt: off
_DECLARED: tuple[Parameter, ...] = (
    # transmitter
    Count("code", "Code", "", "The number sent, from 0 to 2^bits - 1.", 0, 2**MAX_BITS - 1, 718),
    Count("bits", "Bits", "", "How many bits the code has.", 2, MAX_BITS, 10),
    ChipPattern(
        "pattern",
        "Raw chip pattern",
        "",
        "Chips sent over and over in place of packets; empty: packets.",
        "",
    ),
    Quantity(
        "switching_frequency",
        "Switching frequency",
        "f",
        "Chips sent per second; one chip lasts the switching period t_LED = 1/f.",
        unit=HERTZ, low=1.0, high=1e9, slider=(500.0, 100e3), scale="log", default=10e3,
    ),
    Quantity(
        "luminance",
        "Luminance",
        "L_v",
        "Luminance of the lit panel.",
        unit=NIT, low=0.0, high=1e16, slider=(10.0, 1e5), scale="log", default=3600.0,
    ),
    Quantity(
        "panel_width",
        "Panel width",
        "",
        "Size of the panel along the image's columns axis.",
        unit=METRE, low=1e-4, high=100.0, slider=(0.01, 2.0), scale="log", default=0.6,
    ),
    Quantity(
        "panel_height",
        "Panel height",
        "",
        "Size of the panel along the image's rows axis.",
        unit=METRE, low=1e-4, high=100.0, slider=(0.01, 2.0), scale="log", default=0.6,
    ),
    Quantity(
        "edge_time",
        "LED rise and fall time",
        "",
        "Time that the LED takes from dark to lit and from lit to dark; 0: none.",
        unit=SECOND, low=0.0, high=1.0, slider=(0.0, 50e-6), scale="linear", default=0.0,
    ),
    Quantity(
        "lambertian_order",
        "Lambertian order",
        "m",
        "The panel's intensity falls as cos^m of the angle; 1: equally bright from all sides.",
        unit=NONE, low=1.0, high=100.0, slider=(1.0, 10.0), scale="linear", default=1.0,
    ),
    # camera
    Quantity(
        "exposure_time",
        "Exposure time",
        "t",
        "How long one column gathers light.",
        unit=SECOND, low=1e-9, high=1e6, slider=(1e-5, 2e-3), scale="log", default=136e-6,
    ),
    Quantity(
        "readout_time",
        "Readout time",
        "t_r",
        "Delay from one column's start to the next column's.",
        unit=SECOND, low=1e-9, high=10.0, slider=(1e-6, 1e-4), scale="log", default=8e-6,
    ),
    Quantity(
        "iso",
        "ISO speed",
        "S",
        "Gain of the camera.",
        unit=NONE, low=1.0, high=4e6, slider=(50.0, 6400.0), scale="log", default=100.0,
    ),
    Quantity(
        "f_number",
        "Aperture (f-number)",
        "N",
        "Focal length over the diameter of the aperture.",
        unit=NONE, low=0.5, high=128.0, slider=(1.0, 22.0), scale="log", default=2.48,
    ),
    Quantity(
        "gamma",
        "Gamma",
        "γ",  # noqa: RUF001 - the equation's own letter
        "Exponent of the camera's gamma encoding.",
        unit=NONE, low=1.0, high=4.0, slider=(1.0, 4.0), scale="linear", default=2.22,
    ),
    Quantity(
        "meter_constant",
        "Calibration constant",
        "K",
        "Calibration constant of the reflected-light meter.",
        unit=NONE, low=1.0, high=100.0, slider=(10.0, 15.0), scale="linear", default=12.5,
    ),
    Count("rows", "Rows", "", "Pixels of a column.", 1, 100_000, 4608),
    Count("columns", "Columns", "", "Columns read out, one after the other.", 1, 1_000_000, 3456),
    Quantity(
        "equivalent_focal_length",
        "Focal length (35 mm equivalent)",
        "",
        "Focal length of the lens that frames the same picture on a diagonal of 43.27 mm.",
        unit=METRE, low=1e-3, high=2.0, slider=(0.01, 0.2), scale="log", default=0.026,
    ),
    Count(
        "jpeg_quality",
        "JPEG quality",
        "",
        "Quality of the JPEG file that the camera writes, up to 100; 0: no JPEG.",
        0, 100, 0,
    ),
    # lens
    Quantity(
        "vignetting_exponent",
        "Vignetting exponent",
        "",
        "The light falls as cos^n of a pixel's angle off the optical axis: 4 by nature; 0: evenly.",
        unit=NONE, low=0.0, high=20.0, slider=(0.0, 8.0), scale="linear", default=0.0,
    ),
    Quantity(
        "radial_k1",
        "Radial distortion, first",
        "k_1",
        "Radial lens distortion: r (1 + k_1 r^2 + k_2 r^4), r in focal lengths.",
        unit=NONE, low=-10.0, high=10.0, slider=(-0.5, 0.5), scale="linear", default=0.0,
    ),
    Quantity(
        "radial_k2",
        "Radial distortion, second",
        "k_2",
        "Radial lens distortion of the fourth order.",
        unit=NONE, low=-10.0, high=10.0, slider=(-0.5, 0.5), scale="linear", default=0.0,
    ),
    Quantity(
        "tangential_p1",
        "Tangential distortion, first",
        "p_1",
        "Lens distortion by a lens that is off centre along the rows axis.",
        unit=NONE, low=-1.0, high=1.0, slider=(-0.02, 0.02), scale="linear", default=0.0,
    ),
    Quantity(
        "tangential_p2",
        "Tangential distortion, second",
        "p_2",
        "Lens distortion by a lens that is off centre along the columns axis.",
        unit=NONE, low=-1.0, high=1.0, slider=(-0.02, 0.02), scale="linear", default=0.0,
    ),
    Quantity(
        "point_spread",
        "Point spread of the lens",
        "",
        "Standard deviation of the spot that the lens makes of a point in focus; 0: a point.",
        unit=PIXEL, low=0.0, high=1000.0, slider=(0.0, 10.0), scale="linear", default=0.0,
    ),
    Quantity(
        "focus_distance",
        "Focus distance",
        "",
        "Distance at which the lens is sharp; 0: wherever the panel is.",
        unit=METRE, low=0.0, high=1e6, slider=(0.0, 3.0), scale="linear", default=0.0,
    ),
    # sensor
    Quantity(
        "pixel_pitch",
        "Pixel pitch",
        "",
        "Distance from one pixel's centre to the next one's.",
        unit=METRE, low=1e-7, high=1e-4, slider=(0.5e-6, 10e-6), scale="log", default=1e-6,
    ),
    Quantity(
        "quantum_efficiency",
        "Quantum efficiency",
        "",
        "Electrons collected for each photon on the pixel, its colour filter included.",
        unit=NONE, low=1e-3, high=1.0, slider=(0.05, 1.0), scale="linear", default=0.55,
    ),
    Quantity(
        "full_well",
        "Full well",
        "",
        "Electrons that a pixel can hold.",
        unit=ELECTRON, low=10.0, high=1e9, slider=(1e3, 1e5), scale="log", default=4500.0,
    ),
    Quantity(
        "read_noise",
        "Read noise",
        "",
        "Standard deviation of the electrons read from a pixel that holds none.",
        unit=ELECTRON, low=0.0, high=1e4, slider=(0.0, 20.0), scale="linear", default=2.0,
    ),
    Quantity(
        "gain_variation",
        "Fixed-pattern gain (PRNU)",
        "",
        "Standard deviation of the gain from pixel to pixel, as a share; the same in all pictures.",
        unit=NONE, low=0.0, high=0.5, slider=(0.0, 0.05), scale="linear", default=0.008,
    ),
    Count(
        "adc_bits",
        "Converter bits",
        "",
        "Bits of the analogue-to-digital converter, before the gamma encoding.",
        4, 24, 10,
    ),
    # pose
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
    # surroundings
    Quantity(
        "illuminance",
        "External illuminance",
        "E_v",
        "Light that falls on the panel from elsewhere.",
        unit=LUX, low=0.0, high=1e16, slider=(1.0, 1e5), scale="log", default=290.0,
    ),
    Quantity(
        "reflectance",
        "Reflectance",
        "R",
        "Share of that light which the panel and its surroundings throw back.",
        unit=NONE, low=0.0, high=1.0, slider=(0.0, 1.0), scale="linear", default=0.4,
    ),
    Quantity(
        "flicker_depth",
        "Flicker depth",
        "",
        "By which share of its mean the light from elsewhere swings up and down; 0: steady.",
        unit=NONE, low=0.0, high=1.0, slider=(0.0, 1.0), scale="linear", default=0.0,
    ),
    Quantity(
        "flicker_frequency",
        "Flicker frequency",
        "",
        "Frequency of that swing: twice that of the mains.",
        unit=HERTZ, low=0.01, high=1e9, slider=(50.0, 1000.0), scale="log", default=100.0,
    ),
    Quantity(
        "flicker_phase",
        "Flicker phase",
        "",
        "Phase of that swing at time zero; 0: at its crest.",
        unit=RADIAN, low=-math.pi, high=math.pi,
        slider=(-math.pi, math.pi), scale="linear", default=0.0,
    ),
    # receiver
    Quantity(
        "bright_fraction",
        "Brightest pixels",
        "",
        "Share of the image's pixels, the brightest, that mark the panel for the decoder.",
        unit=NONE, low=1e-4, high=0.5, slider=(0.01, 0.2), scale="log", default=0.05,
    ),
    # model
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
        "Whole columns for each chip and each change (literal), or exact run lengths (charitable).",
        ("literal", "charitable"),
        "literal",
    ),
)
# fmt: on

PARAMETERS: dict[str, Parameter] = {parameter.name: parameter for parameter in _DECLARED}


def parameter_named(name: str, among: Iterable[str] = PARAMETERS) -> Parameter:
    """Find a declaration.

    Raises
    ------
    ParameterError
        There is no parameter of that name among ``among``; the closest one is suggested.
    """
    names = list(among)
    if name in names:
        return PARAMETERS[name]
    near = get_close_matches(name, names, n=1)
    hint = f"did you mean {near[0]}?" if near else f"known are {', '.join(names)}."
    raise ParameterError(f"There is no parameter {name!r}; {hint}")
