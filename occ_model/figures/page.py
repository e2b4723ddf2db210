"""Keep texts of any length and language inside a figure's page."""

import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import TypeVar

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, fontManager, get_font
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.textpath import text_to_path

_Kind = TypeVar("_Kind", Text, Legend)

_MARGIN = 0.05  # inches between a text and the page's edge

_HINTED_WIDTH_FACTOR = 1.08  # ratio of the width of small hinted letters to that of their outlines
_MAX_LINES = 12
_MAX_ROUNDS = 3  # how often a page is made higher and its axes are placed again

_UNKNOWN_LETTER = "□"
_POINTS = 72.0  # points per inch


def break_lines(text: str, inches: float, font: FontProperties, most: int) -> list[str]:
    """Break a text into up to ``most`` lines of a width; an ellipsis replaces the rest."""
    letters = max(len(text), 1)
    lines = [text]
    while letters > 1 and max((_inches(line, font) for line in lines), default=0.0) > inches:
        widest = max(lines, key=lambda line: _inches(line, font))
        ratio = _inches(widest, font) / inches
        letters = max(min(int(len(widest) / ratio), letters - 1), 1)
        lines = textwrap.wrap(text, letters, max_lines=most, placeholder="…")
    return lines


def _inches(line: str, font: FontProperties) -> float:
    width, _, _ = text_to_path.get_text_width_height_descent(line, font, ismath=False)
    return _HINTED_WIDTH_FACTOR * float(width) / _POINTS


def fit_texts(figure: Figure) -> None:
    """Break lines that are too wide, narrow the legends, and make the page higher if needed."""
    for text in _find_all(figure, Text):
        replaced, font = replace_missing_letters(text.get_text(), text.get_fontproperties())
        text.set_text(replaced)
        text.set_fontfamily(font.get_family())
    if figure.get_layout_engine() is None:
        return
    for space in _list_text_spaces(figure):
        figure.set_figheight(figure.get_figheight() + space.fit())
    for legend in _find_all(figure, Legend):
        _narrow_legend(legend, figure)
    for _ in range(_MAX_ROUNDS):
        _place_axes(figure)
        above, below = _measure_overflow(figure)
        if not above + below:
            break
        figure.set_figheight(figure.get_figheight() + above + below)
    else:
        _place_axes(figure)
    # Keep these places for the files of all formats.
    figure.set_layout_engine("none")


def _place_axes(figure: Figure) -> None:
    layout = figure.get_layout_engine()
    if layout is not None and figure.axes:
        layout.execute(figure)


def _measure_overflow(figure: Figure) -> tuple[float, float]:
    """Return how many inches the figure extends beyond the page's upper and lower edge."""
    box = figure.get_tightbbox()
    return max(box.y1 - figure.get_figheight(), 0.0), max(-box.y0, 0.0)


def _find_all(figure: Figure, kind: type[_Kind]) -> list[_Kind]:
    return [artist for artist in figure.findobj(kind) if isinstance(artist, kind)]


@dataclass(frozen=True, slots=True)
class _TextSpace:
    """A text and its available width, in inches."""

    text: Text
    inches: float

    def fit(self) -> float:
        """Break the text's lines; return the height in inches of the added ones."""
        lines_before = self.text.get_text().split("\n")
        font = self.text.get_fontproperties()
        lines = [
            line
            for text in lines_before
            for line in break_lines(text, self.inches, font, _MAX_LINES)
        ]
        self.text.set_text("\n".join(lines))
        spacing = 1.2 * float(self.text.get_fontsize()) / _POINTS
        return max(len(lines) - len(lines_before), 0) * spacing


def _list_text_spaces(figure: Figure) -> Iterator[_TextSpace]:
    page = figure.get_figwidth() - 2 * _MARGIN
    for line in (figure._supxlabel, figure._suptitle):  # type: ignore[attr-defined]
        if line is not None:
            yield _TextSpace(line, page)
    headings = [(text, _count_across(ax)) for ax in figure.axes for text in _headings(ax)]
    # Place the axes without headings, as one that is far too wide would squeeze them.
    for is_visible in (False, True):
        for text, _ in headings:
            text.set_visible(is_visible)
        if not is_visible:
            _place_axes(figure)
    for text, axes_in_row in headings:
        yield _TextSpace(text, min(_width_to_edge(text, figure), page / axes_in_row))


def _headings(ax: Axes) -> Iterator[Text]:
    titles = [child for child in ax.get_children() if isinstance(child, Text)]
    for text in (*titles, ax.xaxis.label):
        # Texts in ``ax.texts`` are placed at data coordinates.
        if text.get_text() and text not in ax.texts:
            yield text


def _count_across(ax: Axes) -> int:
    place = ax.get_subplotspec()
    return 1 if place is None else place.get_gridspec().ncols // len(place.colspan)


def _width_to_edge(text: Text, figure: Figure) -> float:
    """Return the width in inches that is available to a text at its place."""
    box, width = text.get_window_extent(), float(figure.get_figwidth())
    left, right = float(box.x0 / figure.dpi), float(box.x1 / figure.dpi)
    match text.get_horizontalalignment():
        case "left":
            return width - _MARGIN - left
        case "right":
            return right - _MARGIN
        case _:
            centre = (left + right) / 2
            return 2 * (min(centre, width - centre) - _MARGIN)


def _narrow_legend(legend: Legend, figure: Figure) -> None:
    columns = int(legend._ncols)  # type: ignore[attr-defined]
    while columns > 1 and legend.get_window_extent().width > figure.bbox.width:
        columns -= 1
        legend.set_ncols(columns)


def replace_missing_letters(text: str, font: FontProperties) -> tuple[str, FontProperties]:
    """Take letters that a font lacks from other fonts, or replace them with a square."""
    missing = set(text) - {"\n"} - _letters_of(fontManager.findfont(font))
    families = list(font.get_family())
    for entry in fontManager.ttflist if missing else ():
        # A file with several fonts, or of another kind, cannot be put into a PDF.
        if entry.fname.endswith(".ttf") and not entry.name.startswith("Last Resort"):
            replaced = missing & _letters_of(entry.fname)
            families += [entry.name] if replaced else []
            missing -= replaced
    font = font.copy()
    font.set_family(families)
    return "".join(_UNKNOWN_LETTER if letter in missing else letter for letter in text), font


@cache
def _letters_of(path: str) -> frozenset[str]:
    return frozenset(map(chr, get_font(path).get_charmap()))
