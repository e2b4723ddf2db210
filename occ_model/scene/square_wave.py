"""The square wave of an LED that only blinks, as a scene."""

from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

SQUARE_WAVE = "10"  # the chips of one cycle: one lit, one dark

CHIPS_OF_A_CYCLE = len(SQUARE_WAVE)

_CHIP_RATE = quantity("switching_frequency")

SQUARE_FREQUENCY = Quantity(
    "square_frequency",
    "Frequency of the square wave",
    "",
    "Cycles per second of a blinking LED, each of two chips: one lit, one dark.",
    unit=_CHIP_RATE.unit,
    low=_CHIP_RATE.low / CHIPS_OF_A_CYCLE,
    high=_CHIP_RATE.high / CHIPS_OF_A_CYCLE,
    slider=(50.0, 2e4),
    scale=_CHIP_RATE.scale,
    default=1000.0,
)


def send_square_wave(scene: Scene, cycles: float) -> Scene:
    """Let a scene send a square wave.

    ``cycles`` is the number per second, a value that ``SQUARE_FREQUENCY`` allows.
    """
    return scene.replace(pattern=SQUARE_WAVE, switching_frequency=CHIPS_OF_A_CYCLE * cycles)


def chips_of_cycle(pattern: str) -> int:
    """Return the number of chips of a pattern with one pulse of any duty, 0 of any other."""
    return len(pattern) if (pattern + pattern[:1]).count("01") == 1 else 0
