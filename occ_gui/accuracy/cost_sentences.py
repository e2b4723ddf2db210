"""Sentences on what a picture costs, and on what another would."""

import math

from occ_gui.accuracy.effect_rows import levels, milliseconds
from occ_model.results.accuracy import Forecast, MeasuredCosts, TimeFractions
from occ_model.results.frame import Frame


def picture_sentence(costs: MeasuredCosts, made: float, expected: Forecast | None) -> str:
    now, then = milliseconds(costs.picture.seconds), milliseconds(made)
    time = f"This picture: {now} ms"
    if costs.is_comparable and now != then:
        time = f"{time}, measured again ({then} at first)"
    return f"{time}; {_error(expected)}." if expected is not None else f"{time}."


def ends_sentence(costs: MeasuredCosts, unit: str) -> str:
    """State the times without any effect and with all of them; empty until both are measured."""
    if not costs.is_comparable:
        return ""
    bare = next((fractions for fractions in costs.others if not fractions.included), None)
    most = max(costs.others, key=lambda fractions: len(fractions.included))
    error = costs.errors.get(frozenset())
    if bare is None or error is None or most is bare:
        return ""
    sentence = f"Fastest: {milliseconds(bare.seconds)} ms, error {levels(error)} {unit}."
    if bare is costs.picture:
        sentence = ""
    if most is not costs.picture:
        sentence += f" Exact: {milliseconds(most.seconds)} ms."
    return sentence.strip()


def forecast_sentence(frame: Frame, times: TimeFractions, expected: Forecast) -> str:
    """State the next picture's time and error, and the effects that it switches."""
    before, after = set(frame.plan.included), set(expected.plan.included)
    now = milliseconds(times.seconds)
    if expected.seconds is None:
        time = f"Next: now {now} ms"
    else:
        time = f"Next: about {milliseconds(expected.seconds)} ms, now {now}"
    labels = {decision.effect: decision.label for decision in frame.plan.decisions}
    parts = [f"{time}; {_error(expected)}."]
    for names, way in ((after - before, "in"), (before - after, "out")):
        if names:
            listed = ", ".join(label for name, label in labels.items() if name in names)
            parts.append(f"Switches {way}: {listed}.")
    return " ".join(parts)


def _error(expected: Forecast) -> str:
    if expected.error is None:
        return _promise(expected)
    if expected.error == 0.0:
        is_exact = expected.plan.tolerance == 0.0
        return "exact: nothing is left out" if is_exact else "nothing is left out"
    error = f"{levels(expected.error)} {expected.plan.unit}"
    return (
        f"error {error} (measured)" if expected.is_measured else f"error about {error} (predicted)"
    )


def _promise(expected: Forecast) -> str:
    """State the error that the plan promises while none is measured or predicted."""
    plan = expected.plan
    off_by_hand = any(d.forced and d.estimate and not d.included for d in plan.decisions)
    if off_by_hand or plan.tolerance == math.inf:
        return "error not measured yet"
    return f"error about {levels(plan.left_out)} {plan.unit} (estimated)"
