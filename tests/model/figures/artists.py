"""Describe a figure in lines of text: what is drawn, where, how large, in which colours."""

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import Collection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text
from matplotlib.transforms import BboxBase

from occ_model.arrays import FloatArray
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


def describe_figure(figure: Figure) -> list[str]:
    """Describe every artist of a figure, except those that matplotlib adds by itself."""
    lines = [f"figure {_numbers(figure.get_size_inches())}"]
    lines += [line for text in figure.texts for line in _describe_artist(text)]
    for name in ("_supxlabel", "_supylabel", "_suptitle"):
        lines += _describe_artist(getattr(figure, name)) if getattr(figure, name) else []
    for legend in figure.legends:
        lines += _describe_artist(legend)
    for number, ax in enumerate(figure.axes):
        lines += [f"axes {number} {line}" for line in _describe_axes(ax)]
    return lines


def _describe_axes(ax: Axes) -> Iterator[str]:
    shown = " ".join(name for name, spine in ax.spines.items() if spine.get_visible())
    yield f"{'on' if ax.axison else 'off'} {ax.get_aspect()} spines {shown}"
    for name, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        yield from (f"{name} {line}" for line in _describe_axis(axis))
    for artist in ax.get_children():
        if not isinstance(artist, Axis) and artist is not ax.patch:
            yield from _describe_artist(artist)


def _describe_axis(axis: Axis) -> Iterator[str]:
    low, high = axis.get_view_interval()
    label = axis.get_label()
    yield f"{axis.get_scale()} from {_numbers([low, high])} label {label.get_text()!r} "
    yield f"label of {label.get_fontsize():g} ticks {_ticks(axis)}"


def _ticks(axis: Axis) -> str:
    how = axis.get_tick_params()
    # Only ticks whose places were set, and not found by a locator.
    fixed = type(axis.get_major_locator()).__name__ == "FixedLocator"
    texts = [label.get_text() for label in axis.get_ticklabels()] if fixed else []
    places = _numbers(axis.get_ticklocs()) if fixed else ""
    return f"{how.get('labelsize')} {how.get('length')} {places} {texts}"


def _describe_artist(artist: Artist) -> list[str]:
    if not artist.get_visible():
        return []
    if isinstance(artist, Legend):
        texts = [line for text in artist.get_texts() for line in _describe_artist(text)]
        handles = [line for handle in artist.legend_handles for line in _describe_artist(handle)]
        columns, place = (getattr(artist, name) for name in ("_ncols", "_loc"))
        return [f"legend {columns} frame {artist.get_frame_on()} {place}", *texts, *handles]
    if isinstance(artist, Text):
        return _describe_text(artist)
    if isinstance(artist, Line2D):
        return [_describe_line(artist)]
    if isinstance(artist, AxesImage):
        data: FloatArray = np.ma.filled(np.ma.asarray(artist.get_array(), dtype=float), np.nan)
        return [
            f"image {data.shape} {_numbers(_summary(data))} in {_numbers(artist.get_extent())} "
            f"levels {_numbers(artist.get_clim())} {artist.get_cmap().name}"
        ]
    if isinstance(artist, Patch):
        path = artist.get_patch_transform().transform_path(artist.get_path())
        return [
            f"patch {_numbers(_summary(path.vertices))} {_colour(artist.get_facecolor())} "
            f"{_colour(artist.get_edgecolor())} {artist.get_linewidth():g} {artist.get_hatch()} "
            f"{artist.get_label()!r} {artist.get_zorder():g}"
        ]
    if isinstance(artist, Collection):
        corners = [_numbers(_summary(path.vertices)) for path in artist.get_paths()[:40]]
        colours = [
            _colour(one) for one in np.vstack([artist.get_facecolor(), artist.get_edgecolor()])[:4]
        ]
        return [
            f"{type(artist).__name__} {len(artist.get_paths())} {corners} {colours} "
            f"{_numbers(artist.get_linewidth())} {_numbers(_summary(artist.get_offsets()))}"
        ]
    return [line for child in artist.get_children() for line in _describe_artist(child)]


def _describe_text(text: Text) -> list[str]:
    if not text.get_text():
        return []
    return [
        f"text {text.get_text()!r} at {_numbers(text.get_position())} of {text.get_fontsize():g} "
        f"{text.get_fontweight()} {_colour(text.get_color())} {text.get_horizontalalignment()} "
        f"{text.get_verticalalignment()} {text.get_rotation():g}"
    ]


def _describe_line(line: Line2D) -> str:
    x, y = (np.asarray(part, dtype=float) for part in line.get_data())
    return (
        f"line {len(x)} {_numbers(_summary(x))} {_numbers(_summary(y))} "
        f"{_colour(line.get_color())} {line.get_linestyle()} {line.get_linewidth():g} "
        f"{line.get_marker()} "
        f"{line.get_markersize():g} {line.get_fillstyle()} {line.get_label()!r} "
        f"{line.get_zorder():g} {line.get_alpha()}"
    )


def _summary(values: Any) -> list[float]:
    """Return all values if they are few, else numbers that change when any of them does."""
    flat: FloatArray = np.ma.filled(np.ma.asarray(values, dtype=float), np.nan).ravel()
    if flat.size <= 12:
        return flat.tolist()
    known = flat[np.isfinite(flat)]
    if not known.size:
        return [flat.size, 0]
    places = np.linspace(1.0, 2.0, known.size)
    return [flat.size, known.size, known.min(), known.max(), known.mean(), (known * places).mean()]


def _numbers(values: Any) -> str:
    return " ".join(f"{float(value) + 0.0:.5g}" for value in np.ravel(np.asarray(values, float)))


def _colour(colour: Any) -> str:
    return to_hex(colour, keep_alpha=True)


def is_alike(found: list[str], stored: list[str]) -> bool:
    """Compare two descriptions, with numbers by value, since last digits differ by rounding."""
    return len(found) == len(stored) and all(map(_is_line_alike, found, stored))


def _is_line_alike(found: str, stored: str) -> bool:
    words, others = (line.translate(_BARE).split() for line in (found, stored))
    return len(words) == len(others) and all(map(_is_word_alike, words, others))


_BARE = str.maketrans(dict.fromkeys("[](),'", " "))


def _is_word_alike(found: str, stored: str) -> bool:
    if found == stored:
        return True
    try:
        one, other = float(found), float(stored)
    except ValueError:
        return False
    return abs(one - other) <= 2e-4 * max(abs(one), abs(other)) + 1e-9
