"""Parameters of the light: the transmitter's and the surroundings'."""

import math

from occ_model import plugins
from occ_model.scene.parameter_kinds import (
    ChipPattern,
    Choice,
    Count,
    OpenChoice,
    Parameter,
    Payload,
    Quantity,
)
from occ_model.scene.units import HERTZ, LUX, METRE, NIT, NONE, RADIAN, SECOND

MAX_BITS = 16

MAX_PREAMBLE_CHIPS = 64

# fmt: off
TRANSMITTER: tuple[Parameter, ...] = (
    Count("code", "Code", "", "The number sent, from 0 to 2^bits - 1.", 0, 2**MAX_BITS - 1, 718),
    Count("bits", "Bits", "", "How many bits the code has.", 2, MAX_BITS, 10),
    Payload(
        "payload",
        "Payload",
        "",
        "Text, bytes or bits that are sent in place of the code; empty: the code.",
        "",
    ),
    OpenChoice(
        "line_code",
        "Line code",
        "",
        "The rule that turns bits into chips.",
        ("differential-manchester", "manchester", "nrz", "4b6b", "8b10b", "fsk"),
        "differential-manchester",
        group=plugins.LINE_CODES,
    ),
    OpenChoice(
        "framing",
        "Framing",
        "",
        "How the chips show where a payload starts, and whether it was read rightly.",
        ("paper", "preamble", "c-ook", "raw"),
        "paper",
        group=plugins.FRAMINGS,
    ),
    ChipPattern(
        "preamble",
        "Preamble",
        "",
        "Chips that start a frame of the framings preamble and raw; empty: the line code's own.",
        "",
        most=MAX_PREAMBLE_CHIPS,
        empty="the line code's own",
    ),
    Choice(
        "error_correction",
        "Error correction",
        "",
        "Bytes added to the payload, by which wrong ones are corrected.",
        ("none", "reed-solomon"),
        "none",
    ),
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
)

SURROUNDINGS: tuple[Parameter, ...] = (
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
)
# fmt: on
