"""Find the texts of a figure that are not wholly on its page."""

from itertools import combinations

from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import BboxBase

from occ_model.figures.page import fit_texts


def find_cut_texts(figure: Figure) -> list[str]:
    """Name the texts of a figure, fitted for a file, that leave the page or cover a title."""
    fit_texts(figure)
    figure.draw_without_rendering()
    page, ticks = figure.bbox.padded(1.0), _tick_labels(figure)
    boxes = {
        text: text.get_window_extent()
        for text in figure.findobj(Text)
        if isinstance(text, Text) and text.get_text() and text.get_visible() and text not in ticks
    }
    inside = {text: _contains_box(page, box) for text, box in boxes.items()}
    said = [text.get_text() for text, is_inside in inside.items() if not is_inside]
    # Tick labels of values outside the axes are not drawn, and do not count here.
    drawn = figure.get_tightbbox().transformed(figure.dpi_scale_trans)
    said += [] if _contains_box(page, drawn) else [f"drawn to {drawn}"]
    titles = [ax.title for ax in figure.axes if ax.title.get_text()]
    for one, other in combinations(titles, 2):
        said += [one.get_text()] if boxes[one].overlaps(boxes[other]) else []
    return said


def _tick_labels(figure: Figure) -> set[Text]:
    axes = [axis for ax in figure.axes for axis in (ax.xaxis, ax.yaxis)]
    return {label for axis in axes for label in axis.get_ticklabels(which="both")}


def _contains_box(page: BboxBase, box: BboxBase) -> bool:
    return page.x0 <= box.x0 and page.y0 <= box.y0 and box.x1 <= page.x1 and box.y1 <= page.y1
