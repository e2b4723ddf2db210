"""Check the arguments of a sweep before any work starts, and build its request."""

import math
import os
from collections.abc import Iterable, Mapping, Sequence

from occ_model.errors import ParameterError, quote
from occ_model.receiver.decode import DECODERS
from occ_model.results.sweep_request import (
    JOBS_A_CORE,
    MOST_AXES,
    MOST_JOBS,
    MOST_POINTS,
    RateSettings,
    SweepRequest,
)
from occ_model.scene.argument_checks import check_count
from occ_model.scene.parameter_kinds import Choice, ParameterValue
from occ_model.scene.parameters import parameter_named
from occ_model.scene.recording import FRAME_RATE
from occ_model.scene.scene import Scene
from occ_model.study.success_rate import check_rate


def build_request(scene: Scene, axes: object, settings: RateSettings) -> SweepRequest:
    check_rate(scene, settings)
    FRAME_RATE.check(settings.frames_a_second)
    if not isinstance(axes, Mapping) or not axes:
        raise ParameterError.of(
            "axes", quote(axes), "one parameter or more by name, a list of values each"
        )
    if len(axes) > MOST_AXES:
        raise ParameterError(f"{len(axes)} parameters are varied; allowed: at most {MOST_AXES}.")
    checked_axes: dict[str, tuple[ParameterValue, ...]] = {}
    for name, values in axes.items():
        checked_axes[str(name)] = _check_axis(name, values)
        check_points(checked_axes)
    return SweepRequest(scene, checked_axes, settings)


def check_points(axes: Mapping[str, Sequence[ParameterValue]]) -> None:
    """Refuse axes with too many combinations."""
    sizes = [len(values) for values in axes.values()]
    points = math.prod(sizes)
    if points > MOST_POINTS:
        counts = " x ".join(f"{size:,}" for size in sizes)
        raise ParameterError(
            f"The sweep has {counts} = {points:,} points; allowed: at most {MOST_POINTS:,}."
            if len(sizes) > 1
            else f"The sweep has {points:,} points; allowed: at most {MOST_POINTS:,}."
        )


def processes_for(jobs: int, points: int) -> int:
    check_count("jobs", jobs, 1, MOST_JOBS)
    return max(1, min(jobs, points, JOBS_A_CORE * (os.cpu_count() or 1)))


def decoders_of(decoder: object) -> tuple[str, ...]:
    """Return the names of the decoders, given one name or several."""
    known = ", ".join(DECODERS)
    if isinstance(decoder, str):
        return (decoder,)
    if not isinstance(decoder, Sequence) or not decoder:
        raise ParameterError.of("decoder", quote(decoder), f"one of {known}, or several")
    for name in decoder:
        if list(decoder).count(name) > 1:
            raise ParameterError.of(
                f"decoder {quote(name)}", "given twice", f"each of {known} once"
            )
    return tuple(decoder)


def _check_axis(name: str, values: object) -> tuple[ParameterValue, ...]:
    parameter = parameter_named(name)
    if name == "pattern":
        raise ParameterError("pattern cannot be varied: a raw pattern has no code to be read.")
    if not parameter.is_of("code"):
        raise ParameterError(
            f"{name} cannot be varied: it belongs to the light {parameter.lights[0]}, which has no "
            "code to be read.",
            parameters=(name,),
        )
    if isinstance(values, str | bytes) or not isinstance(values, Iterable):
        raise parameter.refuse(
            f"varies over {quote(values)}", f"a list of values, {parameter.allowed}"
        )
    distinct_values: dict[ParameterValue, None] = {}
    for value in values:
        checked_value = parameter.check(value)
        if isinstance(parameter, Choice):
            checked_value = str(checked_value)  # strings of an array are not plain ones
        if checked_value in distinct_values:
            text = parameter.format(checked_value)  # type: ignore[arg-type]
            raise parameter.refuse(f"is {text} twice", "values that differ")
        distinct_values[checked_value] = None
        if len(distinct_values) > MOST_POINTS:  # for example from an endless iterator
            raise parameter.refuse("has too many values", f"at most {MOST_POINTS:,}")
    if not distinct_values:
        raise parameter.refuse("has no values to vary over", f"one or more, {parameter.allowed}")
    return tuple(distinct_values)
