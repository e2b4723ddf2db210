"""What is asked of a sweep, checked before any work starts."""

from collections.abc import Iterable, Mapping, Sequence

from occ_model.declarations import Choice, ParameterValue
from occ_model.errors import ParameterError
from occ_model.parameters import parameter_named
from occ_model.receiver.decoders import DECODERS
from occ_model.results import RateSettings, SweepRequest
from occ_model.scene import Scene, check_scene
from occ_model.study.success_rate import check_rate


def checked_request(scene: Scene, axes: object, settings: RateSettings) -> SweepRequest:
    """Make the request for a sweep.

    Parameters
    ----------
    scene
        Where the axes start from.
    axes
        Values by the parameters' names.
    settings
        How each rate is measured.

    Raises
    ------
    ParameterError
        An axis names no parameter, has no values, one that is out of range, or one twice; or the
        settings cannot be.
    """
    check_scene(scene)
    check_rate(scene, settings)
    if not isinstance(axes, Mapping) or not axes:
        raise ParameterError(
            f"axes is {axes!r}; allowed: one parameter or more by name, a list of values each."
        )
    return SweepRequest(scene, {str(n): _axis(n, values) for n, values in axes.items()}, settings)


def decoders_of(decoder: object) -> tuple[str, ...]:
    """Give the decoders that are asked for, by one name or several.

    Raises
    ------
    ParameterError
        There are none, or one is there twice.
    """
    known = ", ".join(DECODERS)
    if isinstance(decoder, str):
        return (decoder,)
    if not isinstance(decoder, Sequence) or not decoder:
        raise ParameterError(f"decoder is {decoder!r}; allowed: one of {known}, or several.")
    for name in decoder:
        if list(decoder).count(name) > 1:
            raise ParameterError(f"decoder {name!r} is there twice; allowed: each of {known} once.")
    return tuple(decoder)


def _axis(name: str, values: object) -> tuple[ParameterValue, ...]:
    parameter = parameter_named(name)
    if name == "pattern":
        raise ParameterError("pattern cannot be varied: a raw pattern holds no code to be read.")
    if isinstance(values, str | bytes) or not isinstance(values, Iterable):
        raise parameter.refuse(f"varies over {values!r}", f"a list of values, {parameter.allowed}")
    checked: dict[ParameterValue, None] = {}
    for value in values:
        own = parameter.check(value)
        if isinstance(parameter, Choice):
            own = str(own)  # an array's strings are no plain ones
        if own in checked:
            text = parameter.format(own)  # type: ignore[arg-type]
            raise parameter.refuse(f"is {text} twice", "values that differ")
        checked[own] = None
    if not checked:
        raise parameter.refuse("has no values to vary over", f"one or more, {parameter.allowed}")
    return tuple(checked)
