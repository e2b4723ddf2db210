"""Ticks and title of an axis of the map."""

import math
from dataclasses import dataclass

from occ_gui.widgets.columns import round_step
from occ_model.scene.parameter_kinds import Quantity


@dataclass(frozen=True, slots=True)
class Tick:
    place: float  # position along the slider, from 0 to 1
    text: str  # the number, in the axis's unit


def choose_axis_unit(quantity: Quantity) -> tuple[str, float]:
    """Choose the unit of an axis: its symbol and its factor in SI units."""
    low, high = quantity.slider
    middle = math.sqrt(low * high) if quantity.scale == "log" else max(abs(low), abs(high))
    return quantity.unit.display(middle)


def write_axis_title(quantity: Quantity, short: bool = False) -> str:
    """Return the title of an axis with its unit; a short one uses the symbol, if any."""
    symbol = choose_axis_unit(quantity)[0]
    name = quantity.symbol.replace("_", "") if short and quantity.symbol else quantity.label
    return f"{name} ({symbol})" if symbol else name


def make_ticks(quantity: Quantity, most: int) -> list[Tick]:
    factor = choose_axis_unit(quantity)[1]
    choose = _choose_log_numbers if quantity.scale == "log" else _choose_linear_numbers
    low, high = (end / factor for end in quantity.slider)
    numbers = choose(low, high, max(2, most))
    return [Tick(quantity.fraction(value * factor), f"{value:g}") for value in numbers]


def _choose_log_numbers(low: float, high: float, most: int) -> list[float]:
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    numbers: list[float] = []
    for steps in ((1.0, 2.0, 5.0), (1.0, 3.0), (1.0,)):
        # Rounded as decimal text: 2e-05, not 2.0000000000000003e-05.
        values = [float(f"{step}e{power}") for power in powers for step in steps]
        numbers = [v for v in values if low * (1 - 1e-9) <= v <= high * (1 + 1e-9)]
        if len(numbers) <= most:
            break
    return numbers[:: math.ceil(len(numbers) / most)] if numbers else [low, high]


def _choose_linear_numbers(low: float, high: float, most: int) -> list[float]:
    step = round_step((high - low) / most)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [float(f"{number * step:.12g}") for number in range(first, last + 1)]
