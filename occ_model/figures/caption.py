"""Captions of figures: the values of a scene in words, and a sentence about its photo."""

from matplotlib.figure import Figure

from occ_model.scene.light_words import blinking_lamp, describe_light
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene

_SIZE = 7  # points, of the letters
_FREQUENCY = "switching_frequency"
_PARAMETERS = ("exposure_time", _FREQUENCY, "readout_time", "distance")


def caption(scene: Scene, about: str = "") -> str:
    """Describe a scene and, with a sentence ``about`` it, the photo beside it."""
    values = ", ".join(_values(scene, about))
    return f"{values}; {about}" if about else values


def _values(scene: Scene, about: str) -> list[str]:
    # A photo does not tell the distance: the scene still has that of the preset before the match.
    names = (name for name in _PARAMETERS if not about or name != "distance")
    return [_format_value(scene, name) for name in names]


def _format_value(scene: Scene, name: str) -> str:
    transmitter = scene.transmitter
    if name == _FREQUENCY and (
        transmitter.light != "code" or blinking_lamp(transmitter) is not None
    ):
        return describe_light(transmitter)
    parameter = PARAMETERS[name]
    value = parameter.format(scene.value(name))  # type: ignore[arg-type]
    return f"{parameter.in_sentence} {value}"


def write_caption(figure: Figure, scene: Scene, about: str = "") -> None:
    """Write the caption of a figure: its scene, and a sentence ``about`` its photo."""
    # With non-breaking spaces, lines end only after a comma.
    values = [value.replace(" ", "\xa0") for value in _values(scene, about)]
    text = "\n".join(filter(None, (", ".join(values), about)))
    # A file's name may contain characters of a formula.
    figure.supxlabel(text, fontsize=_SIZE, parse_math=False)
