"""Why a fit of a lamp's stripes is doubted or refused, in sentences.

Limits were set between photographs of lamps, and photographs and drawings of other regular things.
"""

import math
from collections.abc import Iterator
from typing import TypeAlias

from occ_model.errors import distinct_texts
from occ_model.photo.lamp_fit.cues import Cues

_MOST_FLOOR, _FLOOR_PART, _REFUSED_FLOOR = 0.06, 0.15, 0.25
"""Most unexplained light between the stripes, relative to their height; the part of the expected
light that is added to it; and the limit above which a fit is refused. Lamps have up to 0.05."""
_MOST_MISFIT, _REFUSED_MISFIT = 0.06, 0.12  # relative to the stripes' height
_MOST_UNEXPLAINED, _REFUSED_UNEXPLAINED = 0.1, 0.25  # the same; lamps have up to 0.06
_MOST_BLUR, _BLUR_PART = 0.85, 0.25  # columns, parts of the ramp; lamps have up to 0.76 and 0.24
_USUAL_BLUR, _USUAL_BLUR_PART, _BLUR_DEVIATIONS = 0.62, 0.07, 2.0
"""Largest blur that processing causes: in columns, as a part of the ramp, and the standard
deviations of its error that are added. A lens blurs things, but not a lamp's stripes. 98 % of
simulated lamps have less than 0.60."""
_MOST_DRIFT, _DRIFT_DEVIATIONS, _MOST_ROWS_SCATTER = 0.2, 2.5, 0.35  # columns, deviations, columns
_MOST_SCATTER, _SCATTER_PART, _SCATTER_DEVIATIONS, _REFUSED_SCATTER = 0.12, 0.002, 2.6, 0.1
"""Largest deviation of edges from even spacing: columns plus parts of the period, or a multiple of
what noise causes; and the part of a period above which a fit is refused."""
_LEAST_BITS, _REFUSED_BITS = 7.0, 4.0
_LEAST_STRIPE, _REFUSED_STRIPE = 1.0, 0.5  # columns of the shorter of a stripe and a gap
_LEAST_PERIOD = 4.0  # columns
_LEAST_EXPOSURE, _LEAST_TOLD = 0.005, 16.0
"""Least ramp as a part of the period, and columns of a period from which it is needed: exposures
make ramps, edges of things have only blur. Lamps have at least 0.009."""
_USUAL_TONE, _MOST_UNUSUAL_TONE = 5.0, 6.0
"""Largest distance of the tone curve from usual ones, in standard deviations; the second one with a
noted exposure time or a known duty. 97 % of simulated lamps have less than 5."""
_LEAST_GAP = 6.0  # natural logarithms between the best period and the next
_FEW_EDGES = 8  # number of edges below which a dip of the envelope can be a dark stripe
_LIT_GAPS, _FEW_LOW_EDGES, _MOST_WHITE = 0.9, 8, 0.2
"""Light between the stripes, relative to their height, from which stripes count as low; number of
edges of low stripes that a lamp's shape can imitate, and largest fraction of white columns."""


def floor_limit(cues: Cues) -> float:
    return _MOST_FLOOR + _FLOOR_PART * cues.floor_expected


def refusals(cues: Cues) -> list[str]:
    """Return why stripes are no lamp's; empty if they may be one."""
    return [sentence for value, _, most, sentence in _measures(cues) if value > most]


def doubts(cues: Cues, gap: float, other: float | None, *, is_confirmed: bool) -> list[str]:
    """Return why a fit is doubtful; empty if it is sure.

    ``gap``: evidence over that of the next best period, which has ``other`` columns.
    ``is_confirmed``: whether a noted exposure or a known duty agrees with the stripes.
    """
    found = [sentence for value, most, _, sentence in _measures(cues) if value > most]
    found += _doubts_by_light(cues, is_confirmed=is_confirmed)
    if not is_confirmed:
        found += _doubts_by_exposure(cues)
    if gap < _LEAST_GAP and other is not None:
        found.append(f"A period of {other:.4g} columns explains the stripes nearly as well.")
    return found


_Measure: TypeAlias = tuple[float, float, float, str]
"""A measure, the limits above which it is doubted and refused, and a sentence on it."""


def _in_percent(value: float, most: float, refused: float, sentence: str) -> _Measure:
    texts = distinct_texts(100.0 * value, 100.0 * most, 0)
    return value, most, max(refused, most), sentence.format(*texts)


def _in_columns(value: float, most: float, refused: float, sentence: str) -> _Measure:
    return value, most, max(refused, most), sentence.format(*distinct_texts(value, most, 2))


def _measures(cues: Cues) -> Iterator[_Measure]:
    yield _in_percent(
        cues.floor, floor_limit(cues), _REFUSED_FLOOR,
        "Between the stripes there is {} % of their height more or less light than any duty and "
        "exposure leave, as of things that are no lamp; at most {} %.",
    )  # fmt: skip
    yield _in_percent(
        cues.misfit, _MOST_MISFIT, _REFUSED_MISFIT,
        "The stripes' shape differs by {} % of their height from a lamp's; at most {} %.",
    )  # fmt: skip
    yield _in_percent(
        cues.unexplained, _MOST_UNEXPLAINED, _REFUSED_UNEXPLAINED,
        "Columns differ by {} % of the stripes' height from those of a lamp; at most {} %.",
    )  # fmt: skip
    yield _in_columns(
        abs(cues.drift), _MOST_DRIFT + _DRIFT_DEVIATIONS * cues.drift_error, math.inf,
        "The stripes are not upright: from the first row to the last they shift by {} columns; at "
        "most {}.",
    )  # fmt: skip
    yield _in_columns(
        cues.rows_scatter, _MOST_ROWS_SCATTER, math.inf,
        "Rows of the lamp disagree by {} columns on where the stripes are; at most {}.",
    )  # fmt: skip
    yield _in_columns(
        cues.scatter,
        max(_MOST_SCATTER + _SCATTER_PART * cues.period, _SCATTER_DEVIATIONS * cues.scatter_noise),
        _REFUSED_SCATTER * cues.period,
        "The stripes' edges lie {} columns off even spacing; at most {}.",
    )  # fmt: skip
    yield (
        -cues.bits, -_LEAST_BITS, -_REFUSED_BITS,
        f"Only {cues.edges} edges are in view, which could be evenly spaced by chance: "
        f"{cues.bits:.2g} bits of evidence; at least {_LEAST_BITS:.0f} are needed.",
    )  # fmt: skip
    yield (
        -cues.narrowest, -_LEAST_STRIPE, -_REFUSED_STRIPE,
        f"Stripes or gaps have {cues.narrowest:.2g} columns; at least {_LEAST_STRIPE:.0f}.",
    )  # fmt: skip
    yield (
        -cues.period, -_LEAST_PERIOD, math.inf,
        f"A period has {cues.period:.2g} columns; at least {_LEAST_PERIOD:.0f}.",
    )  # fmt: skip


def _doubts_by_light(cues: Cues, *, is_confirmed: bool) -> list[str]:
    found = []
    blur, tone = max(_MOST_BLUR, _BLUR_PART * cues.ramp), _MOST_UNUSUAL_TONE
    if not is_confirmed:
        usual = max(_USUAL_BLUR, _USUAL_BLUR_PART * cues.ramp)
        blur = min(blur, usual + _BLUR_DEVIATIONS * cues.blur_error)
        tone = _USUAL_TONE
    if cues.blur > blur:
        found.append(
            "The stripes are blurred over {} columns, as a lens blurs the edges of objects; those "
            "of a lamp are blurred over {} at most.".format(*distinct_texts(cues.blur, blur, 2))
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
    if cues.unusual_tone > tone:
        found.append(
            "The camera's tone curve would differ by {} standard deviations from usual ones; at "
            "most {}.".format(*distinct_texts(cues.unusual_tone, tone))
        )
    if cues.dips > 1 or (cues.dips and cues.edges < _FEW_EDGES):
        found.append("The lamp is darker in its middle than at its ends, as by a wide dark stripe.")
    return found


def _doubts_by_exposure(cues: Cues) -> list[str]:
    """Doubt what only a noted exposure time or a known duty can confirm."""
    found, part = [], cues.ramp / cues.period
    if cues.floor_expected:
        found.append(
            "Between the stripes there is light, as with an exposure of a period or more, and "
            "neither a noted exposure time nor a known duty says so."
        )
    if cues.period > _LEAST_TOLD and part < _LEAST_EXPOSURE:
        found.append(
            f"The stripes' edges last {100.0 * part:.2g} % of a period, as those of things that do "
            f"not blink; those of a lamp last {100.0 * _LEAST_EXPOSURE:.1f} % or more, unless a "
            "noted exposure time or a known duty says otherwise."
        )
    return found
