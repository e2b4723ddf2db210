"""What the next move of a slider costs, and what leaving out effects saves, in sentences.

All times are of one kind: the median of the last pictures with the same effects, measured on this
computer, and predicted from the parts of those where there is none yet.
"""

import math
from collections.abc import Sequence

from occ_model.errors import capitalize
from occ_model.results.accuracy import (
    Forecast,
    MeasuredCosts,
    Times,
    format_levels,
    format_milliseconds,
)
from occ_model.results.frame import Decision, Plan

_NOT_MEASURED = "a time that is not measured yet"


def state_move(costs: MeasuredCosts, forecast: Forecast | None) -> str:
    """State when a slider's next move shows a draft, if any, and the picture.

    ``forecast``: that of another plan than the last picture's, if the settings have changed.
    """
    if forecast is not None:
        time = _NOT_MEASURED
        if forecast.seconds is not None:
            now = costs.picture.times.number
            time = f"about {format_milliseconds(forecast.seconds)} ms, now {now} ms"
        return f"A slider's next move: the picture in {time}."
    start = f"a draft in {costs.draft}, then" if costs.draft is not None else ""
    return " ".join(f"A slider's next move: {start} the picture in {costs.picture.times}.".split())


def state_measurement(costs: MeasuredCosts) -> str:
    """State from how many moves the times are."""
    count = costs.picture.times.count
    if count == 1:
        return "The time is that of the last picture; more are measured when nothing moves."
    drafts, meaning = "", ""
    if costs.draft is not None:
        drafts = f" and {costs.draft.count} drafts"
        meaning = " A draft has only some rows of the picture, and is shown while a slider moves."
    return (
        f"Median and range of the last {count} pictures{drafts} with these effects, each after a "
        f"move, on this computer.{meaning}"
    )


def state_saving(costs: MeasuredCosts, forecast: Forecast) -> str:
    """State what the plan leaves out and the time that this saves, or what could save time."""
    plan = forecast.plan
    omitted = _list_omitted(plan)
    if not omitted:
        return f"{capitalize(state_error(forecast))}. {_state_best_saving(costs, forecast)}".strip()
    now = costs.times_with(plan.included)
    complete = costs.times_with(_present(plan))
    names = f"left out: {', '.join(d.label for d in omitted)}; {state_error(forecast)}."
    if complete is None:
        return capitalize(names)
    place = _state_tolerance(plan, omitted)
    if now is None:
        if forecast.seconds is None:
            return f"{place}: {names}"
        time = f"about {format_milliseconds(forecast.seconds)} ms"
    elif now.is_below(complete):
        time = f"{now.number} ms"
    else:
        return (
            f"{place} the saving is within the scatter: {now.number} ms, and "
            f"{complete.number} ms with all effects; {names} {_state_noise_floor(costs, forecast)}"
        ).strip()
    return f"{place}: {time} in place of {complete.number} ms; {names}"


def state_error(forecast: Forecast) -> str:
    """State the error of all that is left out, and how it is known."""
    plan = forecast.plan
    if forecast.error is None:
        is_off = any(d.forced for d in _list_omitted(plan))
        if is_off or plan.tolerance == math.inf:
            return "error not measured yet"
        return f"error about {format_levels(plan.left_out)} {plan.unit} (estimated)"
    if forecast.error == 0.0:
        return "exact: nothing is left out" if plan.tolerance == 0.0 else "nothing is left out"
    error = f"{format_levels(forecast.error)} {plan.unit}"
    return (
        f"error {error} (measured)" if forecast.is_measured else f"error about {error} (predicted)"
    )


def state_switches(before: Plan, after: Plan) -> str:
    """Name the effects that the next picture switches; empty if none."""
    parts = []
    labels = {decision.effect: decision.label for decision in before.decisions}
    old, new = set(before.included), set(after.included)
    for names, direction in ((new - old, "in"), (old - new, "out")):
        if names:
            texts = (label for name, label in labels.items() if name in names)
            parts.append(f"Switches {direction}: {', '.join(texts)}.")
    return " ".join(parts)


def _state_best_saving(costs: MeasuredCosts, forecast: Forecast) -> str:
    """State from which tolerance on time is saved, while nothing is left out."""
    floor = _state_noise_floor(costs, forecast)
    best = next(iter(_savings(costs, forecast)), None)
    if best is None:
        return floor
    error, seconds, effects = best
    plan = forecast.plan
    labels = [d.label for d in plan.decisions if d.estimate and d.effect not in effects]
    saving = (
        f"From {format_levels(error)} {plan.unit} on, the picture takes about "
        f"{format_milliseconds(seconds)} ms, without: {', '.join(labels)}."
    )
    return f"{floor} {saving}".strip()


def _state_noise_floor(costs: MeasuredCosts, forecast: Forecast) -> str:
    """State that no tolerance below the noise saves time, where that is so."""
    noises = [d for d in forecast.plan.decisions if d.kind == "noise" and d.estimate]
    complete = costs.times_with(_present(forecast.plan))
    timed = [s for s in forecast.effect_set_seconds if s is not None]
    is_known = complete is not None and complete.count > 1 and forecast.effect_sets
    if not noises or not is_known or len(timed) < len(forecast.effect_sets):
        return ""
    level = max(_error_without(costs, noise) for noise in noises)
    if any(error < level for error, *_ in _savings(costs, forecast)):
        return ""
    noise = f"{format_levels(level)} {forecast.plan.unit}"
    return f"A tolerance below the noise ({noise}) saves no measurable time."


def _error_without(costs: MeasuredCosts, decision: Decision) -> float:
    difference = costs.differences.get(decision.effect)
    return decision.estimate if difference is None else difference.error


def _savings(costs: MeasuredCosts, forecast: Forecast) -> list[tuple[float, float, frozenset[str]]]:
    """Return the plans that are faster than all effects by more than the runs scatter.

    Of each the tolerance, the seconds and the effects, in the order of the tolerance.
    """
    complete = costs.times_with(_present(forecast.plan))
    if complete is None:
        return []
    found = []
    for each, seconds in zip(forecast.effect_sets, forecast.effect_set_seconds, strict=True):
        if seconds is None or math.isinf(each.error):
            continue
        times = costs.times_with(each.effects) or Times.of((seconds,))
        if times.is_below(complete):
            found.append((each.error, seconds, each.effects))
    return sorted(found, key=lambda saving: saving[0])


def _present(plan: Plan) -> frozenset[str]:
    return frozenset(d.effect for d in plan.decisions if d.estimate)


def _list_omitted(plan: Plan) -> list[Decision]:
    return [d for d in plan.decisions if d.estimate and not d.included]


def _state_tolerance(plan: Plan, omitted: Sequence[Decision]) -> str:
    if any(decision.forced for decision in omitted):
        return "As switched"
    if math.isinf(plan.tolerance):
        return "Without effects"
    return f"At {format_levels(plan.tolerance)} {plan.unit}"
