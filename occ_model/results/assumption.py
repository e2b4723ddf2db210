"""The frequency or readout time that is assumed known when the other is estimated."""

from occ_model.scene.parameters import quantity
from occ_model.scene.square_wave import CHIPS_OF_A_CYCLE
from occ_model.scene.units import HERTZ

_FREQUENCY = "switching_frequency"


def assumption(name: str, value: float, chips: int) -> str:
    """Return the condition under which estimated times hold, as ``"if f = 10 kHz: "``."""
    known = quantity(name)
    if name == _FREQUENCY and chips == CHIPS_OF_A_CYCLE:
        cycles = HERTZ.format(value / CHIPS_OF_A_CYCLE)
        return f"if it is a lamp of {cycles} ({known.format(value)} chips): "
    return f"if {known.symbol} = {known.format(value)}: "
