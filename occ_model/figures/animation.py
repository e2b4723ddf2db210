"""Animations: a parameter changes, and picture, profile and code change with it."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import cv2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D

from occ_model.arrays import ByteArray
from occ_model.camera.photometry import level_values
from occ_model.errors import BandModelUndefined, ParameterError, quote
from occ_model.figures.drawing import BAND, SIMULATION, house_style
from occ_model.figures.page import break_lines
from occ_model.files.writing import check_ending, check_replaceable
from occ_model.receiver.decode import decode
from occ_model.results.decoding import PAPER_DECODER, symptom
from occ_model.results.frame import Frame
from occ_model.scene.declaration import in_sentence
from occ_model.scene.light_words import describe_light
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import parameter_named
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.band_model import band_profile
from occ_model.simulation.render import render_with
from occ_model.study.cause.cause import cause_of
from occ_model.video.file.write import check_film_path, write_frames

ENDINGS = (".gif", ".mp4", ".png")  # GIF, MP4 (MPEG-4), animated PNG
MOST_FRAMES = 300

_SIZE, _DOTS = (9.6, 5.4), 100  # size of a frame in inches, and pixels an inch

_ROWS, _SHOWN_COLUMNS = 120, 900
_DEFAULT_RATE = 15.0
_MAX_GIF_RATE = 50.0  # frames a second, the fastest that players show a GIF file

_HEADROOM, _HIGHEST = 1.2, 260.0  # end of the level axis: factor on the brightest level; maximum
_TITLE_WIDTH, _TITLE_LINES = 8.2, 2  # in inches, and lines; a longer title ends in an ellipsis
_BAND_MODEL = "band model"


def write_animation(  # noqa: PLR0913 - settings, most of them optional
    path: Path,
    scene: Scene,
    name: str,
    values: Sequence[float],
    *,
    settings: SimulationSettings | None = None,
    rate: float = _DEFAULT_RATE,
    decoder: str = PAPER_DECODER,
    progress: Callable[[int], object] = lambda _draw_frames: None,
) -> None:
    """Write an animation of a scene in which a quantity takes ``values``, in SI units, in turn.

    Each frame shows the panel's picture, the profile with that of the band model, and the code that
    the decoder reads. The file (.gif, .mp4, .png) contains the scene. A ParameterError is raised if
    the parameter is not a quantity, a value is out of range, there are no values or more than
    :data:`MOST_FRAMES`, or the rate is not above 0 and at most 50 a second.
    """
    check_ending(path, "an animation", ENDINGS)
    parameter = parameter_named(name)
    if not isinstance(parameter, Quantity):
        raise ParameterError(
            f"{name} cannot change in an animation; allowed: a parameter with a unit."
        )
    light = scene.transmitter.light
    if not parameter.is_of(light):
        raise ParameterError(
            f"{name} cannot change in an animation: it is of the light "
            f"{' or '.join(parameter.lights)}, not of {light}.",
            parameters=(name,),
        )
    if not 1 <= len(values) <= MOST_FRAMES:
        raise ParameterError.of("frames", f"{len(values)}", f"1 to {MOST_FRAMES}")
    if isinstance(rate, bool) or not 0.0 < rate <= _MAX_GIF_RATE:
        raise ParameterError.of("rate", f"{quote(rate)} a second", f"above 0 to {_MAX_GIF_RATE:g}")
    check_film_path(path, rate)
    check_replaceable(path)
    scenes = [scene.replace(**{name: parameter.check(value)}) for value in values]
    frames = _draw_frames(scenes, parameter, settings or SimulationSettings(), decoder, progress)
    note = Provenance(f"Animation over {name}", {"of this file": scene}).text()
    write_frames(path, frames, rate, note)


def _draw_frames(
    scenes: Sequence[Scene],
    parameter: Quantity,
    settings: SimulationSettings,
    decoder: str,
    progress: Callable[[int], object],
) -> Iterator[ByteArray]:
    """Draw and yield the frames, shape (rows, columns, 3)."""
    with house_style():
        brightest = max(float(level_values(scene)[1]) for scene in scenes)
        drawing = AnimatedFigure(parameter, min(_HEADROOM * brightest, _HIGHEST))
        for number, scene in enumerate(scenes, 1):
            frame = render_with(scene, settings)
            yield drawing.draw(frame, _describe_read(frame, decoder, settings))
            progress(number)


def _describe_read(frame: Frame, decoder: str, settings: SimulationSettings) -> str:
    """Describe what was read, after the cause if it differs from what was sent.

    If the light is no code, describe the light.
    """
    scene = frame.scene
    if scene.transmitter.light != "code":
        return describe_light(scene.transmitter)
    result = decode(frame.image, scene, decoder=decoder)
    reading = result.failure or f"code {result.code} read"
    if scene.transmitter.pattern or tuple(result.bits.tolist()) == scene.transmitter.payload_bits:
        return reading
    cause = cause_of(scene, result.decoder, settings)
    return reading if cause is None else f"{cause.what}: {in_sentence(symptom(reading))}"


class AnimatedFigure:
    """A figure of which only curves, picture and texts change from frame to frame."""

    def __init__(self, parameter: Quantity, highest: float) -> None:
        self._parameter = parameter
        self._figure = Figure(figsize=_SIZE, dpi=_DOTS)
        self._canvas = FigureCanvasAgg(self._figure)
        upper, lower = self._figure.subplots(2, 1, height_ratios=(1, 2), sharex=True)
        self._picture: AxesImage = upper.imshow(
            np.zeros((1, 1), np.uint8), cmap="gray", vmin=0, vmax=255, aspect="auto"
        )
        upper.set_yticks([])
        self._title = upper.set_title("", loc="left", fontsize=11, parse_math=False)
        self._lower: Axes = lower
        (self._simulation,) = lower.plot([], [], linewidth=1.4, label="simulation", **SIMULATION)
        (self._band,) = lower.plot([], [], linewidth=1.0, label=_BAND_MODEL, **BAND)
        lower.set(ylim=(0.0, highest), xlabel="column", ylabel="grey level")
        legend = lower.legend(loc="upper right", fontsize=8, ncols=2, frameon=False)
        _, self.band_name = legend.get_texts()

    def draw(self, frame: Frame, reading: str) -> ByteArray:
        first = max(0, int(frame.corners[:, 0].min()))
        last = min(frame.scene.camera.columns, first + _SHOWN_COLUMNS)
        top, bottom = frame.corners[:, 1].min(), frame.corners[:, 1].max()
        rows = slice(max(0, int(top)), max(0, int(bottom)) + 1)
        visible_part = frame.camera_image[rows, first:last]
        if not visible_part.size:  # the panel is outside the picture
            visible_part = frame.camera_image[:, first:last]
        self._picture.set_data(
            cv2.resize(visible_part, (last - first, _ROWS), interpolation=cv2.INTER_AREA)
        )
        self._picture.set_extent((first - 0.5, last - 0.5, 1.0, 0.0))
        columns = np.arange(first, last)
        self._simulation.set_data(columns, frame.profile[first:last])
        is_defined = _show_band(self._band, frame.scene, first, last)
        self.band_name.set_text(_BAND_MODEL if is_defined else f"{_BAND_MODEL} (undefined here)")
        self._lower.set_xlim(first, last)
        value = self._parameter.format(frame.scene.value(self._parameter.name), 4)  # type: ignore[arg-type]
        title, font = (
            f"{self._parameter.label} {value}: {reading}",
            self._title.get_fontproperties(),
        )
        self._title.set_text("\n".join(break_lines(title, _TITLE_WIDTH, font, _TITLE_LINES)))
        self._canvas.draw()  # type: ignore[no-untyped-call]
        pixels = np.asarray(self._canvas.buffer_rgba())  # type: ignore[no-untyped-call]
        return pixels[:, :, :3].copy()


def _show_band(line: Line2D, scene: Scene, first: int, last: int) -> bool:
    """Show the band model's profile; return whether it is defined."""
    try:
        line.set_data(np.arange(first, last), band_profile(scene)[first:last])
    except BandModelUndefined:
        line.set_data([], [])
        return False
    return True
