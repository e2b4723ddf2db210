"""Reading order: the order in which the Tab key goes through a window, as its places are read.

Qt goes by the order in which widgets were made. That of panes, and of what is filled in later, has
nothing to do with where they stand.
"""

from collections.abc import Callable, Iterator, Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

_OVERLAP = 6  # pixels by which the ends of two neighbours may overlap at most and still stand apart

Span = tuple[int, int]


def next_to_focus(window: QWidget, after: QWidget | None, forward: bool) -> QWidget | None:
    """Return the widget of a window that takes the focus next, None where none does.

    ``after``: the widget that has the focus; one that the Tab key does not reach, or none, stands
    before the first and after the last.
    """
    stops = list(focus_stops(window))
    if not stops:
        return None
    step = 1 if forward else -1
    if after not in stops:
        return stops[0 if forward else -1]
    return stops[(stops.index(after) + step) % len(stops)]


def focus_stops(widget: QWidget) -> Iterator[QWidget]:
    """Yield the widgets that the Tab key reaches, in reading order."""
    for child in _as_read(_children(widget)):
        if child.focusPolicy() & Qt.FocusPolicy.TabFocus and child.focusProxy() is None:
            yield child
        yield from focus_stops(child)


def _children(widget: QWidget) -> list[QWidget]:
    found = [
        child
        for child in widget.children()
        if isinstance(child, QWidget)
        and not (child.isWindow() or child.isHidden())
        and child.isEnabled()
    ]
    # A pane behind another one is not hidden: Qt puts it beside the window.
    place = widget.rect()
    return [c for c in found if c.geometry().intersects(place)] if widget.isWindow() else found


def _as_read(widgets: Sequence[QWidget]) -> list[QWidget]:
    """Sort neighbours: by rows, within a row by columns, and so on within a column."""
    for span in (_down, _across):
        groups = _apart(widgets, span)
        if len(groups) > 1:
            return [each for group in groups for each in _as_read(group)]
    return sorted(widgets, key=lambda each: (each.y(), each.x()))


def _down(widget: QWidget) -> Span:
    return _inner(widget.y(), widget.height())


def _across(widget: QWidget) -> Span:
    return _inner(widget.x(), widget.width())


def _inner(start: int, length: int) -> Span:
    """Return a span without its ends, at which it may overlap with the next one."""
    end = min(_OVERLAP, length // 4)
    return start + end, start + length - end


def _apart(widgets: Sequence[QWidget], span: Callable[[QWidget], Span]) -> list[list[QWidget]]:
    """Divide widgets into groups whose spans have nothing in common, from first to last."""
    groups: list[list[QWidget]] = []
    end = 0
    for start, stop, place in sorted((*span(w), place) for place, w in enumerate(widgets)):
        if not groups or start >= end:
            groups.append([])
            end = stop
        groups[-1].append(widgets[place])
        end = max(end, stop)
    return groups
