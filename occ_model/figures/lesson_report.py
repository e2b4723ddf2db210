"""Draw the report of a lesson: one page with a student's answers and what they saw."""

import textwrap
from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from occ_model.camera.photometry import column_profile
from occ_model.errors import OutputError
from occ_model.figures.drawing import SIMULATION, house_style, write_figure
from occ_model.figures.window_panes import caption
from occ_model.results.lessons import AnsweredStep, Lesson
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene

_PAGE = (8.27, 11.69)
"""Inches of a page of A4."""

_LINE = 92
"""Letters of a line."""

_MOST_STEPS = 6
"""Steps of a page that can still be read."""

_SHOWN_COLUMNS = 700
_NO_ANSWER = "(no answer)"


def write_lesson_report(
    path: Path, lesson: Lesson, steps: Sequence[AnsweredStep], *, author: str = "", date: str = ""
) -> None:
    """Write the report of a lesson as one page.

    Parameters
    ----------
    path
        The file: .pdf, .png or .svg.
    lesson
        The lesson.
    steps
        Its steps with the answers, in order; of more than six the first.
    author, date
        Who wrote it, and when; each may be empty.

    Raises
    ------
    OutputError
        There is no step, the ending is none of a figure's, or the file cannot be written.
    """
    if not steps:
        raise OutputError(f"The lesson {lesson.title} has no answers to report.")
    scenes = {f"step {place}": each.scene for place, each in enumerate(steps, 1)}
    provenance = Provenance(f"Report of the lesson: {lesson.title}", scenes, date=date)
    with house_style():
        write_figure(path, _drawn(lesson, steps[:_MOST_STEPS], author, date), provenance)


def _drawn(lesson: Lesson, steps: Sequence[AnsweredStep], author: str, date: str) -> Figure:
    figure = Figure(figsize=_PAGE)
    figure.set_layout_engine("none")
    figure.text(0.08, 0.955, lesson.title, fontsize=16, fontweight="bold")
    about = "   ".join(text for text in (author, date) if text)
    figure.text(0.08, 0.935, about or lesson.summary, fontsize=9, color="0.3")
    height = 0.89 / len(steps)
    for place, each in enumerate(steps):
        top = 0.915 - place * height
        _draw_step(figure, place + 1, each, top, height)
    return figure


def _draw_step(figure: Figure, number: int, each: AnsweredStep, top: float, height: float) -> None:
    answer = each.answer
    given = _NO_ANSWER if answer is None else answer.text
    told = "" if answer is None else answer.sentence
    texts = (
        (f"{number}. {each.step.question}", 10, "bold", "0.0"),
        (f"Answer: {given}", 10, "normal", "0.0"),
        (told, 9, "normal", "0.3"),
        (each.step.answer, 8.5, "normal", "0.3"),
    )
    line = 0.0145
    for text, size, weight, colour in texts:
        wrapped = textwrap.wrap(text, int(_LINE * 10 / max(size, 9)), max_lines=5)
        if not wrapped:
            continue
        figure.text(
            0.08, top, "\n".join(wrapped), fontsize=size, fontweight=weight, color=colour,
            verticalalignment="top", linespacing=1.25, parse_math=False,
        )  # fmt: skip
        top -= line * len(wrapped) + 0.004
    used = line * 0.5
    bottom = 0.915 - (number - 1) * height - height + 0.045
    room = top - used - bottom
    if room > 0.03:
        _draw_profile(figure.add_axes((0.12, bottom, 0.8, min(room, 0.2))), each.scene)


def _draw_profile(ax: Axes, scene: Scene) -> None:
    shown = min(_SHOWN_COLUMNS, scene.camera.columns)
    ax.plot(column_profile(scene)[:shown], linewidth=0.9, **SIMULATION)  # type: ignore[arg-type]
    ax.set_xlim(0, shown)
    ax.set_xlabel(f"column   ({caption(scene)})", fontsize=7, parse_math=False)
    ax.set_ylabel("grey level", fontsize=7)
    ax.tick_params(labelsize=7)
