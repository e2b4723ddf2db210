"""Figures: what a pane says of each figure that can be exported."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from occ_gui.simulation.snapshot import Snapshot
from occ_model.errors import OccError

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing

Draw: TypeAlias = "Callable[[], Drawing]"
"""Makes a drawing, on another thread than the window's: it touches no widget."""


class NothingToDraw(OccError):  # noqa: N818 - not an error: the data are not complete yet
    """There are no data yet for a figure."""


@dataclass(frozen=True, kw_only=True)
class Figure:
    name: str
    title: str
    draw: Callable[[Any, Snapshot], Draw]
    """Says how the figure is drawn, of the pane and the results on the window; the pane is None
    where it was never seen. Raises NothingToDraw."""
    is_another: Callable[[Any], bool] = lambda _pane: True
    """Whether it differs at the moment from all other figures."""
