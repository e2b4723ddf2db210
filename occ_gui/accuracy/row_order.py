"""Order of the table of effects: as light travels, or by a column that the user clicked.

A proxy model would sort by a strict order; times that are about equal have none.
"""

from collections.abc import Sequence
from typing import TypeAlias

from occ_gui.accuracy.effect_rows import ELSE, EffectRow

STAGE, PICTURE, EFFECT, ERROR, TIME, SWITCH = range(6)

SORTED = (STAGE, EFFECT, ERROR, TIME)

LEAST_SCATTER = 0.1
"""Times that differ by less than this fraction of the longer are about equal, measured or not."""

Order: TypeAlias = tuple[int, bool]  # a column, and whether its largest value comes first

AS_LIGHT_TRAVELS: Order = (STAGE, False)


def arranged(
    rows: Sequence[EffectRow], order: Order, present: Sequence[str] = ()
) -> tuple[EffectRow, ...]:
    """Arrange rows.

    ``order``: what to sort by. Rows without a value come last.
    ``present``: the effects in their present order. Rows whose times are about equal keep it: a
    time that is measured again is another, and would shuffle them.
    """
    column, falls = order
    kept = [row for row in rows if row.effect == ELSE]
    effects = [row for row in rows if row.effect != ELSE]
    if column == STAGE:
        return (*(reversed(effects) if falls else effects), *kept)
    if column == EFFECT:
        effects.sort(key=lambda row: row.label.casefold(), reverse=falls)
        return (*effects, *kept)
    unknown = [row for row in effects if _value(row, column) is None]
    known = [row for row in effects if _value(row, column) is not None]
    if column == TIME and {row.effect for row in known} <= set(present):
        known.sort(key=lambda row: present.index(row.effect))
        _mend(known, falls)
    else:
        known.sort(key=lambda row: _value(row, column) or 0.0, reverse=falls)
    return (*known, *unknown, *kept)


def are_about_equal(one: EffectRow, other: EffectRow) -> bool:
    """Whether the times of two rows differ by no more than they scatter."""
    times = one.seconds or 0.0, other.seconds or 0.0
    scatter = max(one.scatter, other.scatter, LEAST_SCATTER * max(times))
    return abs(times[0] - times[1]) <= scatter


def slowest_of(rows: Sequence[EffectRow], before: str = "") -> str:
    """Return the effect in the picture that takes most time; empty where there is none.

    ``before``: the effect that took most time so far: it still does where another takes about as
    much.
    """
    timed = [r for r in rows if r.seconds is not None and r.included and r.effect != ELSE]
    if not timed:
        return ""
    slowest = max(timed, key=lambda row: row.seconds or 0.0)
    equal = (row for row in timed if row.effect == before and are_about_equal(row, slowest))
    return next(equal, slowest).effect


def _value(row: EffectRow, column: int) -> float | None:
    return row.seconds if column == TIME else row.levels


def _mend(rows: list[EffectRow], falls: bool) -> None:
    """Swap neighbours that stand wrong by more than the scatter, until there are none."""
    swapped = True
    while swapped:
        swapped = False
        for place in range(len(rows) - 1):
            above, below = rows[place], rows[place + 1]
            is_less = (above.seconds or 0.0) < (below.seconds or 0.0)
            if is_less == falls and not are_about_equal(above, below):
                rows[place], rows[place + 1] = below, above
                swapped = True
