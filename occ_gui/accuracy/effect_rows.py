"""Rows of the table of effects, and their order.

A proxy model would sort by a strict order; times that are about equal have none.
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from occ_model.results.accuracy import (
    EffectCrop,
    EffectDifference,
    Forecast,
    MeasuredCosts,
    format_levels,
    format_milliseconds,
)
from occ_model.results.frame import Decision, Frame
from occ_model.scene.scene import unit_of

EVERYTHING_ELSE = "everything else"  # key of the last row, which is no effect

_STAGES = {"light": "Light", "optics": "Optics", "sensor": "Sensor", "processing": "File"}
"""Stages of the light's path, in words for a narrow column."""


@dataclass(frozen=True, slots=True)
class EffectRow:
    effect: str  # the effect's name; ``EVERYTHING_ELSE`` in the last row
    stage: str  # the stage of the light's path; empty in the last row
    label: str  # the effect's name on the screen
    # Change of the picture without it, in levels or margins; None where the scene does not have it
    levels: float | None = None
    limit: float | None = None  # the plan's upper limit of this change
    error_text: str = ""  # the change as text
    error_meaning: str = ""  # how the change is known, as a sentence
    seconds: float | None = None  # its computing time; None where it has none of its own
    scatter: float = 0.0  # scatter of repeated measurements of the time, in seconds
    time_text: str = ""
    reason: str = ""  # the plan's reason, as a sentence
    included: bool = True
    is_absent: bool = False  # whether the effect is neither in the scene nor simulated
    is_new: bool = False  # whether the plan has just switched it
    # Whether the present controls would switch it on (True) or off (False)
    pending: bool | None = None
    icon: EffectCrop | None = None  # None until it is known


def make_rows(
    frame: Frame, costs: MeasuredCosts, switched: Collection[str], forecast: Forecast | None = None
) -> tuple[EffectRow, ...]:
    """Return the effects in the order that light passes them, then everything else.

    ``switched``: the effects that the plan has just switched; ``forecast``: that of the present
    controls.
    """
    rows = []
    for decision in frame.plan.decisions:
        pending = None
        if forecast is not None:
            will_include = decision.effect in forecast.plan
            pending = will_include if will_include != decision.included else None
        error = _state_error(decision, costs.differences.get(decision.effect), frame.plan.unit)
        is_new = decision.effect in switched
        rows.append(_make_row(decision, costs, error, is_new, pending))
    rest = costs.picture.other_seconds
    stages = "\n".join(
        f"{name}: {format_milliseconds(s)} ms" for name, s in costs.picture.stages.items()
    )
    reason = f"Time that belongs to no effect, in ms:\n{stages}"
    last = EffectRow(
        EVERYTHING_ELSE,
        "",
        "Everything else",
        seconds=rest,
        time_text=format_milliseconds(rest),
        reason=reason,
    )
    return (*rows, last)


def find_longest_time(rows: Sequence[EffectRow]) -> float:
    return max((row.seconds for row in rows if row.seconds is not None), default=0.0)


def _make_row(
    decision: Decision,
    costs: MeasuredCosts,
    error: tuple[str, str],
    is_new: bool,
    pending: bool | None,
) -> EffectRow:
    difference = costs.differences.get(decision.effect)
    seconds = costs.seconds_of(decision.effect)
    time = "" if seconds is None or not decision.estimate else format_milliseconds(seconds)
    if time and costs.shares_step_with(decision.effect) is not None:
        seconds, time = None, "with noise"
    if time and not decision.included:
        time = f"({time})"
    estimate = decision.estimate if decision.limit < math.inf else None
    error_levels = estimate if difference is None else difference.error
    return EffectRow(
        decision.effect,
        _STAGES[decision.stage],
        decision.label,
        error_levels if decision.estimate else None,
        decision.limit or None,
        *error,
        seconds if time else None,
        costs.scatter_of(decision.effect) if time else 0.0,
        time,
        f"{decision.label}: {decision.reason}",
        decision.included,
        is_absent=not decision.estimate and not decision.included,
        is_new=is_new,
        pending=pending,
        icon=None if difference is None else difference.icon,
    )


def _state_error(
    decision: Decision, difference: EffectDifference | None, unit: str
) -> tuple[str, str]:
    if not decision.estimate:
        return "none", "The scene does not have this effect."
    is_known = decision.limit < math.inf
    estimate = f"{format_levels(decision.estimate)} {unit}"
    if difference is None:
        if not is_known:
            return "?", decision.reason
        meaning = f"Leaving it out changes about {estimate} (estimated)."
        return f"≈ {format_levels(decision.estimate)}", meaning
    error = format_levels(difference.error)
    meaning = f"Leaving it out of the complete picture changes {error} {unit} (measured)"
    if not is_known:
        return error, f"{meaning}."
    if unit == unit_of("decision"):  # the plan's number is no root mean square there
        return error, f"{meaning}, root mean square; its peaks beside the threshold, {estimate}."
    return error, f"{meaning}, {estimate} were estimated."


STAGE, PICTURE, EFFECT, ERROR, TIME, SWITCH = range(6)

SORTABLE = (STAGE, EFFECT, ERROR, TIME)

LEAST_SCATTER = 0.1
"""Fraction of the longer of two times below which their difference does not count."""

Order: TypeAlias = tuple[int, bool]  # a column, and whether its largest value comes first

LIGHT_ORDER: Order = (STAGE, False)


def sort_rows(
    rows: Sequence[EffectRow], order: Order, present: Sequence[str] = ()
) -> tuple[EffectRow, ...]:
    """Sort rows; those without a value come last.

    Rows with about equal times keep their ``present`` order: repeated measurements differ a little
    and would shuffle them.
    """
    column, is_descending = order
    last = [row for row in rows if row.effect == EVERYTHING_ELSE]
    effects = [row for row in rows if row.effect != EVERYTHING_ELSE]
    if column == STAGE:
        return (*(reversed(effects) if is_descending else effects), *last)
    if column == EFFECT:
        effects.sort(key=lambda row: row.label.casefold(), reverse=is_descending)
        return (*effects, *last)
    unknown = [row for row in effects if _find_value(row, column) is None]
    known = [row for row in effects if _find_value(row, column) is not None]
    if column == TIME and {row.effect for row in known} <= set(present):
        known.sort(key=lambda row: present.index(row.effect))
        _swap_neighbours(known, is_descending)
    else:
        known.sort(key=lambda row: _find_value(row, column) or 0.0, reverse=is_descending)
    return (*known, *unknown, *last)


def are_about_equal(one: EffectRow, other: EffectRow) -> bool:
    """Return whether the times of two rows differ by no more than their scatter."""
    times = one.seconds or 0.0, other.seconds or 0.0
    scatter = max(one.scatter, other.scatter, LEAST_SCATTER * max(times))
    return abs(times[0] - times[1]) <= scatter


def find_slowest(rows: Sequence[EffectRow], previous: str = "") -> str:
    """Return the slowest effect of the picture, or ``previous`` where that takes about as long."""
    with_time = [
        r for r in rows if r.seconds is not None and r.included and r.effect != EVERYTHING_ELSE
    ]
    if not with_time:
        return ""
    slowest = max(with_time, key=lambda row: row.seconds or 0.0)
    equal = (row for row in with_time if row.effect == previous and are_about_equal(row, slowest))
    return next(equal, slowest).effect


def _find_value(row: EffectRow, column: int) -> float | None:
    return row.seconds if column == TIME else row.levels


def _swap_neighbours(rows: list[EffectRow], is_descending: bool) -> None:
    """Swap neighbours that are out of order by more than the scatter."""
    has_swapped = True
    while has_swapped:
        has_swapped = False
        for place in range(len(rows) - 1):
            above, below = rows[place], rows[place + 1]
            is_less = (above.seconds or 0.0) < (below.seconds or 0.0)
            if is_less == is_descending and not are_about_equal(above, below):
                rows[place], rows[place + 1] = below, above
                has_swapped = True
