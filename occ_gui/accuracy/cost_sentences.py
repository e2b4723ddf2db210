"""Sentences on the costs of a picture, and of another."""

import math

from occ_gui.accuracy.effect_rows import levels, milliseconds
from occ_model.results.accuracy import Forecast, MeasuredCosts, TimeFractions
from occ_model.results.frame import Frame


def describe_picture(costs: MeasuredCosts, seconds: float, forecast: Forecast | None) -> str:
    now, first = milliseconds(costs.picture.seconds), milliseconds(seconds)
    time = f"This picture: {now} ms"
    if costs.is_comparable and now != first:
        time = f"{time}, measured again ({first} at first)"
    return f"{time}; {_describe_error(forecast)}." if forecast is not None else f"{time}."


def describe_ends(costs: MeasuredCosts, unit: str) -> str:
    """State the times without effects and with all of them; empty until both are measured."""
    if not costs.is_comparable:
        return ""
    bare = next((fractions for fractions in costs.others if not fractions.included), None)
    complete = max(costs.others, key=lambda fractions: len(fractions.included))
    error = costs.errors.get(frozenset())
    if bare is None or error is None or complete is bare:
        return ""
    sentence = f"Fastest: {milliseconds(bare.seconds)} ms, error {levels(error)} {unit}."
    if bare is costs.picture:
        sentence = ""
    if complete is not costs.picture:
        sentence += f" Exact: {milliseconds(complete.seconds)} ms."
    return sentence.strip()


def describe_forecast(frame: Frame, times: TimeFractions, forecast: Forecast) -> str:
    """State the next picture's time and error, and the effects that it switches."""
    before, after = set(frame.plan.included), set(forecast.plan.included)
    now = milliseconds(times.seconds)
    if forecast.seconds is None:
        time = f"Next: now {now} ms"
    else:
        time = f"Next: about {milliseconds(forecast.seconds)} ms, now {now}"
    labels = {decision.effect: decision.label for decision in frame.plan.decisions}
    parts = [f"{time}; {_describe_error(forecast)}."]
    for names, direction in ((after - before, "in"), (before - after, "out")):
        if names:
            texts = (label for name, label in labels.items() if name in names)
            parts.append(f"Switches {direction}: {', '.join(texts)}.")
    return " ".join(parts)


def _describe_error(forecast: Forecast) -> str:
    if forecast.error is None:
        return _describe_promise(forecast)
    if forecast.error == 0.0:
        is_exact = forecast.plan.tolerance == 0.0
        return "exact: nothing is left out" if is_exact else "nothing is left out"
    error = f"{levels(forecast.error)} {forecast.plan.unit}"
    return (
        f"error {error} (measured)" if forecast.is_measured else f"error about {error} (predicted)"
    )


def _describe_promise(forecast: Forecast) -> str:
    """State the error that the plan promises while none is measured or predicted."""
    plan = forecast.plan
    is_off_by_hand = any(d.forced and d.estimate and not d.included for d in plan.decisions)
    if is_off_by_hand or plan.tolerance == math.inf:
        return "error not measured yet"
    return f"error about {levels(plan.left_out)} {plan.unit} (estimated)"
