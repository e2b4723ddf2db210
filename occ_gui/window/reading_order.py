"""Reading order: the Tab key goes through the widgets of a window by rows and columns.

Qt follows the order in which widgets were made, which for panes and later widgets has nothing to do
with their places.
"""

from collections.abc import Callable, Iterator, Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

_OVERLAP = 6  # most pixels by which two widgets may overlap and still count as separate

Span = tuple[int, int]


def next_to_focus(window: QWidget, after: QWidget | None, forward: bool) -> QWidget | None:
    """Return the widget of a window that gets the focus next; None if there is none.

    ``after``: the widget that has the focus. If it is None or the Tab key does not
    reach it, the first widget comes next, or backward the last.
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
    for child in _sort(_list_children(widget)):
        if child.focusPolicy() & Qt.FocusPolicy.TabFocus and child.focusProxy() is None:
            yield child
        yield from focus_stops(child)


def _list_children(widget: QWidget) -> list[QWidget]:
    visible = [
        child
        for child in widget.children()
        if isinstance(child, QWidget)
        and not (child.isWindow() or child.isHidden())
        and child.isEnabled()
    ]
    # A pane behind another one is not hidden: Qt puts it beside the window.
    area = widget.rect()
    return (
        [child for child in visible if child.geometry().intersects(area)]
        if widget.isWindow()
        else visible
    )


def _sort(widgets: Sequence[QWidget]) -> list[QWidget]:
    """Sort siblings by rows, those of a row by columns, those of a column by rows and so on."""
    for span in (_vertical_span, _horizontal_span):
        groups = _group(widgets, span)
        if len(groups) > 1:
            return [widget for group in groups for widget in _sort(group)]
    return sorted(widgets, key=lambda widget: (widget.y(), widget.x()))


def _vertical_span(widget: QWidget) -> Span:
    return _shrink(widget.y(), widget.height())


def _horizontal_span(widget: QWidget) -> Span:
    return _shrink(widget.x(), widget.width())


def _shrink(start: int, length: int) -> Span:
    """Return a span without its ends, which may overlap with its neighbours."""
    end = min(_OVERLAP, length // 4)
    return start + end, start + length - end


def _group(widgets: Sequence[QWidget], span: Callable[[QWidget], Span]) -> list[list[QWidget]]:
    """Divide widgets into groups whose spans do not overlap, from first to last."""
    groups: list[list[QWidget]] = []
    end = 0
    for start, stop, place in sorted(
        (*span(widget), place) for place, widget in enumerate(widgets)
    ):
        if not groups or start >= end:
            groups.append([])
            end = stop
        groups[-1].append(widgets[place])
        end = max(end, stop)
    return groups
