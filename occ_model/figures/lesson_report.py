"""Reports of lessons: a student's answers and results, as pages for print."""

from collections.abc import Iterator, Sequence
from io import BytesIO
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties

from occ_model.camera.photometry import column_profile
from occ_model.errors import OutputError, make_printable, one_line
from occ_model.figures.caption import caption
from occ_model.figures.drawing import (
    FIGURE_ENDINGS,
    PHOTO,
    SIMULATION,
    figure_bytes,
    house_style,
)
from occ_model.figures.page import break_lines, replace_missing_letters
from occ_model.files.writing import check_ending, write_whole
from occ_model.results.match import Match
from occ_model.results.teaching import AnsweredStep, Lesson
from occ_model.scene.parameters import quantity
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene
from occ_model.teaching.answers import explanation
from occ_model.version import __version__


def write_lesson_report(
    path: Path, lesson: Lesson, steps: Sequence[AnsweredStep], *, author: str = "", date: str = ""
) -> None:
    """Write a lesson's report as .pdf, or one page as a picture.

    An OutputError is raised if there are no steps, the ending is another one, a picture would need
    a second page, or the disk fails.
    """
    if not steps:
        raise OutputError(f"The lesson {one_line(lesson.title)} has no answers to report.")
    scenes = {f"step {place}": step.scene for place, step in enumerate(steps, 1)}
    provenance = Provenance(f"Report of the lesson: {lesson.title}", scenes, date=date)
    about = ", ".join(text for text in (author, date) if text) or lesson.summary
    ending = check_ending(path, "a report", FIGURE_ENDINGS)
    with house_style():
        parts = tuple(split_into_pages(steps))
        if len(parts) > 1 and ending != ".pdf":
            raise OutputError(
                f"{one_line(path.name)}: the report has {len(parts)} pages; allowed ending: .pdf."
            )
        pages = [
            draw_page(lesson.title, about, _footer(place, len(parts)), part, first)
            for place, (first, part) in enumerate(parts, 1)
        ]
        content = (
            _pdf_bytes(pages, provenance)
            if len(pages) > 1
            else figure_bytes(pages[0], ending.removeprefix("."), provenance)
        )
    write_whole(path, content)


def _footer(page: int, pages: int) -> str:
    number = f", page {page} of {pages}" if pages > 1 else ""
    return f"occ-explorer {__version__}{number}"


def _pdf_bytes(pages: Sequence[Figure], provenance: Provenance) -> bytes:
    content = BytesIO()
    about = {"Title": provenance.title, "Subject": provenance.text(), "CreationDate": None}
    with PdfPages(content, metadata=about) as pdf:
        for page in pages:
            pdf.savefig(page)
    return content.getvalue()


_PAGE = (8.27, 11.69)  # inches of an A4 page
_LEFT, _RIGHT = 0.08, 0.92  # margins of the lines, as fractions of the page's width
_MAX_STEPS_A_PAGE = 5  # most steps on a page, for legibility
_PLACES_OF_A_MATCH = 2  # places on a page that a step with a match takes

_SHOWN_COLUMNS = 700
_NO_ANSWER = "." * 60
_TOP, _BOTTOM = 0.915, 0.025


def split_into_pages(
    steps: Sequence[AnsweredStep],
) -> Iterator[tuple[int, tuple[AnsweredStep, ...]]]:
    """Yield, for each page, the number of its first step, from 1, and its steps."""
    page: list[AnsweredStep] = []
    for place, step in enumerate(steps):
        if page and sum(map(_count_places, page)) + _count_places(step) > _MAX_STEPS_A_PAGE:
            yield place - len(page) + 1, tuple(page)
            page = []
        page.append(step)
    yield len(steps) - len(page) + 1, tuple(page)


def _count_places(step: AnsweredStep) -> int:
    return 1 if step.match is None else _PLACES_OF_A_MATCH


def draw_page(
    title: str, about: str, foot: str, steps: Sequence[AnsweredStep], first: int
) -> Figure:
    """Draw an A4 page; ``first`` is the number of its first step."""
    figure = Figure(figsize=_PAGE)
    figure.set_layout_engine("none")
    _write_lines(figure, 0.97, title, FontProperties(size=16, weight="bold"), "0.0", most=1)
    _write_lines(figure, 0.945, about, FontProperties(size=9), "0.3", most=1)
    figure.text(_RIGHT, 0.015, foot, fontsize=7, color="0.3", horizontalalignment="right")
    unit = (_TOP - _BOTTOM) / sum(map(_count_places, steps))
    top = _TOP
    for place, step in enumerate(steps, first):
        height = unit * _count_places(step)
        _draw_step(figure, place, step, top, top - height)
        top -= height
    return figure


def _draw_step(
    figure: Figure, number: int, answered: AnsweredStep, top: float, bottom: float
) -> None:
    answer = answered.answer
    answer_text = _NO_ANSWER if answer is None else answered.step.with_unit(answer.text)
    outcome = "" if answer is None else answer.sentence
    matched = "" if answered.match is None else describe_match(answered.match, answered.photo)
    texts = (
        (f"{number}. {answered.step.question}", 10, "bold", "0.0"),
        (f"Answer: {answer_text}", 10, "normal", "0.0"),
        (outcome, 9, "normal", "0.3"),
        (matched, 9, "normal", "0.0"),
        (explanation(answered.step, answered.scene), 8.5, "normal", "0.3"),
    )
    line = 0.0145
    for text, size, weight, colour in texts:
        lines = _write_lines(figure, top, text, FontProperties(size=size, weight=weight), colour)
        top -= line * lines + 0.004 * (lines > 0)
    _draw_result(figure, answered, top - line * 0.5, bottom + 0.045)


def _write_lines(
    figure: Figure, top: float, text: str, font: FontProperties, colour: str, most: int = 5
) -> int:
    """Write a text below a height of the page, in up to ``most`` lines; return their number."""
    # Do not break lines between a value and its error.
    unbroken = make_printable(text).replace(" ± ", "\xa0±\xa0")
    text, font = replace_missing_letters(unbroken, font)
    lines = break_lines(text, (_RIGHT - _LEFT) * _PAGE[0], font, most) if text else []
    figure.text(
        _LEFT, top, "\n".join(lines), fontproperties=font, color=colour,
        verticalalignment="top", linespacing=1.25, parse_math=False,
    )  # fmt: skip
    return len(lines)


def _draw_result(figure: Figure, answered: AnsweredStep, top: float, bottom: float) -> None:
    height = min(top - bottom, 0.2 * _count_places(answered))
    if height <= 0.03:
        return
    if answered.match is None:
        draw_profile(figure.add_axes((0.12, bottom, 0.8, height)), answered.scene)
        return
    residual_axes = figure.add_axes((0.12, bottom, 0.8, height * 0.3))
    profile_axes = figure.add_axes(
        (0.12, bottom + height * 0.36, 0.8, height * 0.64), sharex=residual_axes
    )
    draw_match((profile_axes, residual_axes), answered.match)


def describe_match(match: Match, photo: str) -> str:
    """Describe a match: its verdict, values with standard deviations, and reasons to doubt it."""
    facts = [f"photo {one_line(photo)}: {match.verdict}" if photo else match.verdict]
    for name in ("readout_time", "exposure_time"):
        parameter = quantity(name)
        deviation = match.uncertainties.get(name)
        value = parameter.unit.format_estimate(getattr(match, name), deviation)
        doubt = " (doubtful)" if name in match.doubtful_alone else ""
        facts.append(f"{parameter.in_sentence} {value}{doubt}")
    exposure = f"{match.exposure_in_chips:.3g} chips"
    if match.lamp is not None:
        exposure = f"{match.exposure_in_periods:.3g} periods of a {match.lamp.words}"
    facts.append(f"{exposure} an exposure, residual {match.rmse:.2g} levels")
    return " ".join((f"{'; '.join(facts)}.", *match.all_reasons))


def draw_profile(ax: Axes, scene: Scene) -> None:
    columns = min(_SHOWN_COLUMNS, scene.camera.columns)
    ax.plot(column_profile(scene)[:columns], linewidth=0.9, **SIMULATION)  # type: ignore[arg-type]
    ax.set_xlim(0, columns)
    ax.set_xlabel(f"column   ({caption(scene)})", fontsize=7, parse_math=False)
    ax.set_ylabel("grey level", fontsize=7)
    ax.tick_params(labelsize=7)


def draw_match(axes: Sequence[Axes], match: Match) -> None:
    """Draw a photo's profile and the fitted one, with the residual below."""
    profile_axes, residual_axes = axes
    columns = min(_SHOWN_COLUMNS, len(match.profile))
    profile_axes.plot(match.stripes.profile[:columns], linewidth=0.9, label="photo", **PHOTO)  # type: ignore[arg-type]
    profile_axes.plot(match.profile[:columns], linewidth=0.9, label="fit", **SIMULATION)  # type: ignore[arg-type]
    # Above the axes it covers no curve.
    profile_axes.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, frameon=False, fontsize=7,
        borderaxespad=0.0,
    )  # fmt: skip
    profile_axes.set_ylabel("grey level", fontsize=7)
    profile_axes.tick_params(labelsize=7, labelbottom=False)
    residual_axes.plot(match.residual[:columns], linewidth=0.8, color="0.3")
    residual_axes.axhline(0.0, linewidth=0.5, color="0.0")
    residual_axes.set_xlim(0, columns)
    residual_axes.set_ylabel("photo − fit\n(grey levels)", fontsize=7)  # noqa: RUF001
    residual_axes.set_xlabel("column of the lamp", fontsize=7)
    residual_axes.tick_params(labelsize=7)
