"""An estimate with its error in words, and an upper limit where the error is large."""

from occ_model.scene.parameter_kinds import Quantity

_LARGEST_ERROR = 0.5  # relative standard deviation above which only an upper limit is stated
_LIMIT_DEVIATIONS = 2.0  # number of standard deviations by which the limit exceeds the estimate


def estimate_text(quantity: Quantity, value: float, deviation: float | None) -> str:
    """Write an estimate with its standard deviation, to the digits that are significant.

    An exposure time that is hardly known is stated as an upper limit, since the value less its
    error would be negative.

    ``value``, ``deviation``: in SI units; without a deviation the value alone is written.
    """
    text = quantity.unit.format_estimate(value, deviation)
    if quantity.name != "exposure_time" or deviation is None or deviation <= _LARGEST_ERROR * value:
        return text
    return f"below {quantity.format(value + _LIMIT_DEVIATIONS * deviation, 2)} ({text})"
