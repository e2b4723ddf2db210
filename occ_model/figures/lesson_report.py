"""Report of a lesson: a student's answers and what they saw, as pages for print or as Markdown."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from urllib.parse import quote

from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure

from occ_model.errors import OutputError, one_line, printable
from occ_model.figures.drawing import figure_bytes, house_style, write_figure
from occ_model.figures.lesson_steps import (
    draw_match,
    draw_page,
    draw_profile,
    match_lines,
    steps_of_pages,
)
from occ_model.files.writing import make_folder, write_whole
from occ_model.results.lessons import AnsweredStep, Lesson
from occ_model.scene.provenance import Provenance
from occ_model.teaching.explanations import explanation
from occ_model.version import __version__

_FIGURE = (7.0, 2.6)  # inches of a figure in Markdown

_MATCHED_FIGURE = (7.0, 4.2)


def write_lesson_report(
    path: Path, lesson: Lesson, steps: Sequence[AnsweredStep], *, author: str = "", date: str = ""
) -> None:
    """Write the report of a lesson: .pdf, .md with a folder of figures, or one page as picture.

    Raises OutputError: no step, another ending, a second page of a picture, or a failing disk.
    """
    if not steps:
        raise OutputError(f"The lesson {one_line(lesson.title)} has no answers to report.")
    scenes = {f"step {place}": each.scene for place, each in enumerate(steps, 1)}
    provenance = Provenance(f"Report of the lesson: {lesson.title}", scenes, date=date)
    about = "   ".join(text for text in (author, date) if text) or lesson.summary
    with house_style():
        if path.suffix.lower() == ".md":
            _write_markdown(path, lesson, steps, about)
            return
        parts = tuple(steps_of_pages(steps))
        pages = [
            draw_page(lesson.title, about, _foot(place, len(parts)), part, first)
            for place, (first, part) in enumerate(parts, 1)
        ]
        if len(pages) == 1:
            write_figure(path, pages[0], provenance)
        elif path.suffix.lower() == ".pdf":
            write_whole(path, _pdf(pages, provenance))
        else:
            raise OutputError(
                f"{one_line(path.name)}: the report has {len(pages)} pages; "
                "allowed endings: .pdf and .md."
            )


def _foot(page: int, pages: int) -> str:
    number = f", page {page} of {pages}" if pages > 1 else ""
    return f"occ-explorer {__version__}{number}"


def _pdf(pages: Sequence[Figure], provenance: Provenance) -> bytes:
    content = BytesIO()
    about = {"Title": provenance.title, "Subject": provenance.text(), "CreationDate": None}
    with PdfPages(content, metadata=about) as pdf:
        for page in pages:
            pdf.savefig(page)
    return content.getvalue()


def _write_markdown(path: Path, lesson: Lesson, steps: Sequence[AnsweredStep], about: str) -> None:
    folder = path.with_name(f"{path.stem}-figures")
    make_folder(folder)
    lines = [f"# {_plain(lesson.title)}", "", _plain(about), ""]
    for place, each in enumerate(steps, 1):
        figure = folder / f"step-{place}.png"
        _write_step_figure(figure, each)
        lines += [f"## {place}. {_plain(each.step.question)}", ""]
        if each.answer is None:
            lines += ["*(no answer)*", ""]
        else:
            lines += [
                f"**Answer:** {_plain(each.step.with_unit(each.answer.text))}",
                "",
                _plain(each.answer.sentence),
                "",
            ]
        if each.match is not None:
            lines += [*(f"* {_plain(line)}" for line in match_lines(each.match, each.photo)), ""]
        lines += [f"![What was seen]({quote(folder.name)}/{figure.name})", ""]
        lines += [f"> {_plain(explanation(each.step, each.scene))}", ""]
    scene = steps[-1].scene.to_toml()
    lines += [f"Scene of the last step, occ-explorer {__version__}:", "", "```toml", scene, "```"]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _write_step_figure(path: Path, each: AnsweredStep) -> None:
    figure = Figure(figsize=_FIGURE if each.match is None else _MATCHED_FIGURE)
    if each.match is None:
        draw_profile(figure.subplots(), each.scene)
    else:
        draw_match(figure.subplots(2, 1, sharex=True, height_ratios=(2, 1)), each.match)
    title = each.step.question
    write_whole(path, figure_bytes(figure, "png", Provenance(title, {"step": each.scene})))


def _plain(text: str) -> str:
    """Write a text so that Markdown shows it as it is."""
    text = printable(text)
    for sign in "\\`*_[]<>#|&":
        text = text.replace(sign, f"\\{sign}")
    return text
