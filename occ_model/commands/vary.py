"""Parse the values of a varied parameter, such as ``2kHz:20kHz:2kHz``."""

import math
from collections.abc import Iterable

import numpy as np

from occ_model.errors import ParameterError, quote
from occ_model.results.sweep_request import MOST_POINTS
from occ_model.scene.parameter_kinds import Count, Parameter, ParameterValue, Quantity
from occ_model.scene.parameters import parameter_named
from occ_model.study.sweep.request_check import check_points

SYNTAX = (  # what :func:`axes_of` parses
    "NAME=a,b,c: these values; NAME=low:high:step: from low in even steps, with high if a step "
    "meets it; NAME=low:high:xN: N values from low to high, in even ratios if the parameter's "
    "slider is logarithmic (frequency, times, distance), else in even steps"
)

_DIGITS = 12  # significant digits of a value in even steps, so that 0.6 + 3 x 0.2 gives 1.2


def axes_of(settings: Iterable[str]) -> dict[str, list[ParameterValue]]:
    """Parse axes such as ``"switching_frequency=2kHz:20kHz:2kHz"``."""
    axes: dict[str, list[ParameterValue]] = {}
    for setting in settings:
        name, equals, text = setting.partition("=")
        name = name.strip()
        if not equals:
            raise ParameterError(f"{quote(setting)} is not an axis; allowed: {SYNTAX}.")
        parameter = parameter_named(name)
        if name in axes:
            raise parameter.refuse("is varied twice", "one axis a parameter")
        axes[name] = _parse_values(parameter, text)
        check_points(axes)  # before making the next axis
    return axes


def _parse_values(parameter: Parameter, text: str) -> list[ParameterValue]:
    if ":" not in text:
        if text.count(",") >= MOST_POINTS:
            raise parameter.refuse("has too many values", f"at most {MOST_POINTS:,}")
        return [parameter.parse(part) for part in text.split(",")]
    parts = text.split(":")
    if len(parts) != 3 or not isinstance(parameter, Quantity | Count):
        raise parameter.refuse(f"varies over {quote(text)}", _allowed_forms(parameter))
    low, high = parameter.parse(parts[0]), parameter.parse(parts[1])
    if not low < high:
        raise parameter.refuse(
            f"varies over {quote(text)}", "a range from a lower to a higher value"
        )
    step = parts[2].strip()
    if step[:1] in ("x", "X"):
        return _spread_values(parameter, low, high, step)
    return _step_values(parameter, low, high, step)


def _allowed_forms(parameter: Parameter) -> str:
    if isinstance(parameter, Quantity | Count):
        return "low:high:step, low:high:xN, or values with commas between them"
    return "values with commas between them"


def _spread_values(
    parameter: Quantity | Count, low: float, high: float, text: str
) -> list[ParameterValue]:
    """Return N values from low to high, in even ratios or steps."""
    factor = text[1:].lstrip("0")
    # Python does not convert numbers of thousands of digits.
    is_whole = factor.isdecimal() and len(factor) <= len(str(MOST_POINTS))
    count = int(factor) if is_whole else 0
    if not 2 <= count <= MOST_POINTS:
        raise parameter.refuse(f"varies in {quote(text)}", f"x2 to x{MOST_POINTS} values")
    if isinstance(parameter, Count):
        return list(dict.fromkeys(np.rint(np.linspace(low, high, count)).astype(int).tolist()))
    is_log = parameter.scale == "log" and low > 0.0
    values = (np.geomspace if is_log else np.linspace)(low, high, count).tolist()
    return [low, *(float(f"{value:.6g}") for value in values[1:-1]), high]


def _step_values(
    parameter: Quantity | Count, low: float, high: float, text: str
) -> list[ParameterValue]:
    """Return the values from low to high in even steps."""
    step = (
        parameter.unit.parse(text) if isinstance(parameter, Quantity) else _parse_whole_number(text)
    )
    if step is None or not step > 0.0 or math.isinf(step):
        raise parameter.refuse(f"varies in steps of {quote(text)}", "a step above 0")
    steps = (high - low) / step * (1 + 1e-9)
    if steps < 1.0:  # there would be only the first value
        raise parameter.refuse(
            f"varies in steps of {quote(text)}", "a step above 0, no larger than the range"
        )
    if steps >= MOST_POINTS:  # possibly infinitely many
        count = f"{math.floor(steps) + 1} values" if steps < 1e15 else "too many values"
        raise parameter.refuse(f"varies over {count}", f"up to {MOST_POINTS}")
    last = math.floor(steps)
    if isinstance(parameter, Count):
        return [int(low + index * step) for index in range(last + 1)]
    values = (float(f"{low + index * step:.{_DIGITS}g}") for index in range(last + 1))
    return [min(value, high) for value in values]


def _parse_whole_number(text: str) -> float | None:
    return float(text) if text.strip().isdecimal() else None
