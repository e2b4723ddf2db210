"""Why a fit of a lamp's stripes is doubted or refused, in sentences."""

from occ_model.errors import distinct_texts
from occ_model.photo.lamp_fit.cues import Cues

_MOST_FLOOR, _FLOOR_PART = 0.06, 0.15  # of the stripes' height, and of the floor that is expected
_MOST_BLUR, _BLUR_PART = 0.85, 0.15  # columns, and of the ramp
_LEAST_EXPOSURE, _LEAST_TOLD = 0.005, 16.0
"""Least ramp as a part of the period, and columns of a period from which it is told: cameras expose
for a line at least, and edges of things have no ramp but by blur."""
_MOST_DRIFT, _MOST_ROWS_SCATTER = 0.2, 0.35  # columns
_DRIFT_DEVIATIONS = 2.5
_MOST_SCATTER, _SCATTER_PART, _SCATTER_DEVIATIONS = 0.12, 0.002, 2.6
_LEAST_BITS = 7.0
_GAMMAS = (0.9, 6.0)
_LEAST_PERIOD = 4.0  # columns
_MOST_MISFIT = 0.06  # of the swing
_MOST_UNEXPLAINED, _REFUSED_UNEXPLAINED = 0.1, 0.25  # of the swing; of lamps 0.06 at most
_LEAST_GAP = 6.0  # natural logarithms between the best period and the next
_FEW_EDGES = 8  # below which a dip of the light can be a dark stripe
_LIT_GAPS, _FEW_LOW_EDGES, _MOST_WHITE = 0.9, 8, 0.2
"""Light between the stripes over their height from which they are low; most edges of low stripes
that the lamp's own shape may pretend, and part of white columns that may hide more of them."""
_LEAST_STRIPE, _REFUSED_STRIPE = 1.0, 0.5  # columns of the shorter of a stripe and a gap
_REFUSED_BITS, _REFUSED_FLOOR, _REFUSED_MISFIT, _REFUSED_SCATTER = 4.0, 0.25, 0.12, 0.1
"""Limits of a refusal: bits, fractions of the height and of the swing, part of the period."""


def floor_limit(cues: Cues) -> float:
    return _MOST_FLOOR + _FLOOR_PART * cues.floor_expected


def refusals(cues: Cues) -> list[str]:
    """Return why stripes are no lamp's; empty if they may be one."""
    found = []
    if cues.bits < _REFUSED_BITS:
        found.append(
            f"Only {cues.edges} edges of stripes are in view, evenly spaced within "
            f"{cues.scatter:.2g} columns: that can be chance."
        )
    if cues.floor > max(_REFUSED_FLOOR, floor_limit(cues)):
        found.append(_floor_sentence(cues))
    if cues.misfit > _REFUSED_MISFIT:
        found.append(_misfit_sentence(cues))
    if cues.unexplained > _REFUSED_UNEXPLAINED:
        found.append(_unexplained_sentence(cues))
    if cues.scatter > max(_REFUSED_SCATTER * cues.period, _scatter_limit(cues)):
        found.append(_scatter_sentence(cues))
    if cues.narrowest < _REFUSED_STRIPE:
        found.append(_narrow_sentence(cues))
    return found


def doubts(cues: Cues, gap: float, other: float | None, *, is_confirmed: bool) -> list[str]:
    """Return why a fit is doubtful; empty if it is sure.

    ``gap``: evidence over that of the next best period, ``other`` in columns.
    ``is_confirmed``: whether a noted exposure or a known duty agrees with the stripes.
    """
    found = [*_doubts_by_light(cues, is_confirmed), *_doubts_by_edges(cues, is_confirmed)]
    if gap < _LEAST_GAP and other is not None:
        found.append(f"A period of {other:.4g} columns explains the stripes nearly as well.")
    return found


def _doubts_by_light(cues: Cues, is_confirmed: bool) -> list[str]:
    found = []
    if cues.floor > floor_limit(cues):
        found.append(_floor_sentence(cues))
    if cues.floor_expected and not is_confirmed:
        found.append(
            "Between the stripes there is light, as with an exposure of a period or more, and "
            "neither a noted exposure time nor a known duty says so."
        )
    if cues.floor_expected >= _LIT_GAPS and (
        cues.edges <= _FEW_LOW_EDGES or cues.white > _MOST_WHITE
    ):
        white, most = distinct_texts(100.0 * cues.white, 100.0 * _MOST_WHITE, 0)
        found.append(
            f"The light between the stripes is {cues.floor_expected:.2g} times as high as they "
            f"are. Of such stripes more than {_FEW_LOW_EDGES} edges are needed, of which "
            f"{cues.edges} are in view, and at most {most} % white columns, of which "
            f"there are {white} %."
        )
    low, high = _GAMMAS
    if not low <= cues.gamma <= high:
        found.append(f"The camera's gamma would be {cues.gamma:.2g}; allowed: {low:g} to {high:g}.")
    if cues.dips > 1 or (cues.dips and cues.edges < _FEW_EDGES):
        found.append("The lamp is darker in its middle than at its ends, as by a wide dark stripe.")
    if cues.misfit > _MOST_MISFIT:
        found.append(_misfit_sentence(cues))
    if cues.unexplained > _MOST_UNEXPLAINED:
        found.append(_unexplained_sentence(cues))
    return found


def _doubts_by_edges(cues: Cues, is_confirmed: bool) -> list[str]:
    found = []
    if cues.blur > (most := _blur_limit(cues)):
        found.append(f"The stripes are blurred over {cues.blur:.2g} columns; at most {most:.2g}.")
    if abs(cues.drift) > _MOST_DRIFT + _DRIFT_DEVIATIONS * cues.drift_error:
        found.append(
            f"The stripes are not upright: from the first row to the last they shift by "
            f"{abs(cues.drift):.2g} columns."
        )
    if cues.rows_scatter > _MOST_ROWS_SCATTER:
        found.append(
            f"Rows of the lamp disagree by {cues.rows_scatter:.2g} columns on where the stripes "
            f"are; at most {_MOST_ROWS_SCATTER:.2g}."
        )
    is_steep = cues.period > _LEAST_TOLD and cues.ramp < _LEAST_EXPOSURE * cues.period
    if is_steep and not is_confirmed:
        part, least = 100.0 * cues.ramp / cues.period, 100.0 * _LEAST_EXPOSURE
        found.append(
            f"The stripes' edges last {part:.2g} % of a period, as those of things that do not "
            f"blink; those of a lamp last {least:.1f} % or more, unless a noted exposure time or a "
            "known duty says otherwise."
        )
    if cues.scatter > _scatter_limit(cues):
        found.append(_scatter_sentence(cues))
    if cues.bits < _LEAST_BITS:
        found.append(
            f"Only {cues.edges} edges are in view, which could be evenly spaced by chance: "
            f"{cues.bits:.2g} bits of evidence; at least {_LEAST_BITS:.0f} are needed."
        )
    if cues.period < _LEAST_PERIOD:
        found.append(f"A period has {cues.period:.2g} columns; at least {_LEAST_PERIOD:.0f}.")
    if cues.narrowest < _LEAST_STRIPE:
        found.append(_narrow_sentence(cues))
    return found


def _blur_limit(cues: Cues) -> float:
    return max(_MOST_BLUR, _BLUR_PART * cues.ramp)


def _scatter_limit(cues: Cues) -> float:
    return max(
        _MOST_SCATTER + _SCATTER_PART * cues.period, _SCATTER_DEVIATIONS * cues.scatter_noise
    )


def _narrow_sentence(cues: Cues) -> str:
    return f"Stripes or gaps have {cues.narrowest:.2g} columns; at least {_LEAST_STRIPE:.0f}."


def _scatter_sentence(cues: Cues) -> str:
    return (
        f"The stripes' edges lie {cues.scatter:.2g} columns off even spacing; at most "
        f"{_scatter_limit(cues):.2g}."
    )


def _floor_sentence(cues: Cues) -> str:
    return (
        f"Between the stripes there is {100.0 * cues.floor:.2g} % of their height more or less "
        "light than any duty and exposure leave, as of things that are no lamp; at most "
        f"{100.0 * floor_limit(cues):.2g} %."
    )


def _misfit_sentence(cues: Cues) -> str:
    return (
        f"The stripes' shape differs by {100.0 * cues.misfit:.2g} % of their height from a lamp's; "
        f"at most {100.0 * _MOST_MISFIT:.0f} %."
    )


def _unexplained_sentence(cues: Cues) -> str:
    return (
        f"Columns differ by {100.0 * cues.unexplained:.2g} % of the stripes' height from those of "
        f"a lamp; at most {100.0 * _MOST_UNEXPLAINED:.0f} %."
    )
