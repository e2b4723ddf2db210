"""What measured times rest on: the frequency, or the readout time, that is taken as known."""

import math
from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

from occ_model.scene.parameters import quantity
from occ_model.scene.square_wave import CHIPS_OF_A_CYCLE
from occ_model.scene.units import HERTZ

_FREQUENCY = "switching_frequency"


def is_certain(name: str, value: float, certain: Mapping[str, float]) -> bool:
    """Whether a known value is confirmed and not only assumed.

    Parameters
    ----------
    name
        The parameter that was taken as known.
    value
        Its value in SI units.
    certain
        The values that the user has confirmed, in SI units by name.
    """
    return math.isclose(value, certain.get(name, math.nan), rel_tol=1e-9)


def condition(name: str, value: float, certain: Mapping[str, float], chips: int) -> str:
    """Name the value that estimates rest on, as ``"if f = 10 kHz: "``; empty where it is certain.

    Parameters
    ----------
    name, value, certain
        As for :func:`is_certain`.
    chips
        Chips of a period: a lamp that only blinks is known by its cycles.
    """
    if is_certain(name, value, certain):
        return ""
    known = quantity(name)
    if name == _FREQUENCY and chips == CHIPS_OF_A_CYCLE:
        return _tr("if it is a lamp of {cycles} ({chips} chips): ").format(
            cycles=HERTZ.format(value / CHIPS_OF_A_CYCLE), chips=known.format(value)
        )
    return _tr("if {symbol} = {value}: ").format(symbol=known.symbol, value=known.format(value))


def _tr(text: str) -> str:
    return QCoreApplication.translate("Assumption", text)
