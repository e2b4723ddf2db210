"""The values that a parameter is varied over, as people write them."""

import math
from collections.abc import Iterable

import numpy as np

from occ_model.declarations import Count, Parameter, ParameterValue, Quantity
from occ_model.errors import ParameterError
from occ_model.parameters import parameter_named

SYNTAX = (
    "NAME=a,b,c: these values; NAME=low:high:step: from low in even steps, with high where a step "
    "meets it; NAME=low:high:xN: N values from low to high, in even ratios where the parameter's "
    "slider is logarithmic (frequency, times, distance), else in even steps"
)
"""What :func:`axes_of` reads."""

_MOST = 1_000_000
_DIGITS = 12
"""Significant digits of a value that is counted up to: 0.6 + 3 x 0.2 is 1.2 to anyone."""


def axes_of(settings: Iterable[str]) -> dict[str, list[ParameterValue]]:
    """Read axes such as ``"switching_frequency=2kHz:20kHz:2kHz"``.

    Raises
    ------
    ParameterError
        A text is no axis, names no parameter or one a second time, or a value is out of range.
    """
    axes: dict[str, list[ParameterValue]] = {}
    for setting in settings:
        name, equals, text = setting.partition("=")
        name = name.strip()
        if not equals:
            raise ParameterError(f"{setting!r} is no axis; allowed: {SYNTAX}.")
        parameter = parameter_named(name)
        if name in axes:
            raise parameter.refuse("is varied twice", "one axis a parameter")
        axes[name] = _values(parameter, text)
    return axes


def _values(parameter: Parameter, text: str) -> list[ParameterValue]:
    if ":" not in text:
        return [parameter.parse(part) for part in text.split(",")]
    parts = text.split(":")
    if len(parts) != 3 or not isinstance(parameter, Quantity | Count):
        raise parameter.refuse(f"varies over {text!r}", _forms(parameter))
    low, high = parameter.parse(parts[0]), parameter.parse(parts[1])
    if not low < high:
        raise parameter.refuse(f"varies over {text!r}", "a range from a lower to a higher value")
    step = parts[2].strip()
    if step[:1] in ("x", "X"):
        return _spread(parameter, low, high, step)
    return _stepped(parameter, low, high, step)


def _forms(parameter: Parameter) -> str:
    if isinstance(parameter, Quantity | Count):
        return "low:high:step, low:high:xN, or values with commas between them"
    return "values with commas between them"


def _spread(
    parameter: Quantity | Count, low: float, high: float, text: str
) -> list[ParameterValue]:
    """Give N values from low to high."""
    if not text[1:].isdecimal() or not 2 <= int(text[1:]) <= _MOST:
        raise parameter.refuse(f"varies in {text!r}", f"x2 to x{_MOST} values")
    number = int(text[1:])
    if isinstance(parameter, Count):
        return list(dict.fromkeys(np.rint(np.linspace(low, high, number)).astype(int).tolist()))
    is_log = parameter.scale == "log" and low > 0.0
    even = (np.geomspace if is_log else np.linspace)(low, high, number).tolist()
    return [low, *(float(f"{value:.6g}") for value in even[1:-1]), high]


def _stepped(
    parameter: Quantity | Count, low: float, high: float, text: str
) -> list[ParameterValue]:
    """Give the values from low to high in even steps."""
    step = parameter.unit.parse(text) if isinstance(parameter, Quantity) else _whole(text)
    if step is None or not step > 0.0 or math.isinf(step):
        raise parameter.refuse(f"varies in steps of {text!r}", "a step above 0")
    last = math.floor((high - low) / step * (1 + 1e-9))
    if last >= _MOST:
        raise parameter.refuse(f"varies over {last + 1} values", f"up to {_MOST}")
    if isinstance(parameter, Count):
        return [int(low + place * step) for place in range(last + 1)]
    values = (float(f"{low + place * step:.{_DIGITS}g}") for place in range(last + 1))
    return [min(value, high) for value in values]


def _whole(text: str) -> float | None:
    return float(text) if text.strip().isdecimal() else None
