"""Feature: the declaration of a pane or a service."""

import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeAlias, TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QLabel, QWidget

from occ_gui.background.task import Task
from occ_gui.core.workspace import Workspace
from occ_gui.shell.results import MadeOf, Results
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.modes import Places, Side
from occ_model.errors import OccError

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing


Draw: TypeAlias = "Callable[[], Drawing]"  # makes a drawing on a background thread, without widgets


def defer(name: str, *arguments: Any, **named: Any) -> Callable[..., Any]:
    """Return a function that imports and calls ``module:name`` with these arguments."""

    def call(*more: Any) -> Any:
        return pkgutil.resolve_name(name)(*arguments, *more, **named)

    return call


class NothingToDraw(OccError):  # noqa: N818 - not an error: the data is not complete yet
    """There is no data yet for a figure."""


@dataclass(frozen=True, kw_only=True)
class Figure:
    name: str
    title: str
    draw: Callable[[Any, Snapshot], Draw]
    """Takes the pane, None if it was never shown, and the shown results; returns a function that
    draws the figure. Raises NothingToDraw."""
    differs_from_others: Callable[[Any], bool] = lambda _pane: True
    """Takes the pane; returns whether the figure now differs from all others."""


Part = TypeVar("Part")


class CodeVerdictView(Protocol):
    """A part of a pane that shows whether the code was read."""

    def show_outdated(self, outdated: bool) -> None: ...

    def show_run(self, value: str, picture_value: str) -> None: ...


class BackgroundWork(Protocol):
    @property
    def is_idle(self) -> bool: ...

    def stop(self) -> None: ...


class Service(QObject):
    """Carries out the commands of a feature; made when first needed."""

    status_message = Signal(str)
    file_failed = Signal(str)  # why a file was not opened or saved

    tasks: tuple[Task[Any, Any], ...] = ()
    """Work that counts for :attr:`is_idle`, and that stops with the service."""

    measures: tuple[BackgroundWork, ...] = ()
    """Background measurements that no picture waits for; they stop with the service."""

    @property
    def is_idle(self) -> bool:
        return all(task.is_idle for task in self.tasks)

    @property
    def is_measured(self) -> bool:
        return all(work.is_idle for work in self.measures)

    def stop(self) -> None:
        for work in (*self.tasks, *self.measures):
            work.stop()


class Pane(Service, Generic[Part]):
    """A widget with its connections, made when its pane is first shown."""

    made_of: Mapping[QWidget, MadeOf] = MappingProxyType({})
    """Widgets that are marked while their results are of an earlier scene."""

    accepted = Signal()  # an allowed value was entered, whether or not it differs from the last one

    verdicts: tuple[CodeVerdictView, ...] = ()

    sentences: tuple[QLabel, ...] = ()
    """Labels with sentences that the status line need not repeat while they are visible."""

    def __init__(self, widget: QWidget) -> None:
        super().__init__()
        self.widget = widget

    def show_part(self, part: Part) -> None:
        """Show this part of workspace and results in place of the last one."""

    def set_visible(self, visible: bool) -> None:
        """Note whether the pane is visible; parts are shown only while it is."""


class PiecesPane(Pane[tuple[Any, ...]]):
    """A pane that redraws only the pieces of its part that have changed."""

    def __init__(self, widget: QWidget, *show_functions: Callable[[Any], object]) -> None:
        super().__init__(widget)
        self._show_functions = show_functions
        self._last_part: tuple[Any, ...] = (None,) * len(show_functions)

    def show_part(self, part: tuple[Any, ...]) -> None:
        last_part, self._last_part = self._last_part, part
        for show, piece, last in zip(self._show_functions, part, last_part, strict=True):
            if piece is not last:
                show(piece)


@dataclass(frozen=True, kw_only=True)
class Feature(Generic[Part]):
    """A pane of the window, or a service without one.

    ``make`` is called when the pane is first shown, or one of ``commands`` is first called; heavy
    modules are imported only then.
    """

    name: str
    title: str = ""  # the title of the pane; empty for a service
    places: Places = field(default_factory=dict)
    """Where each mode shows the pane at first."""
    default_side: Side = "bottom"  # its side in modes that do not show it at first
    help: str = ""  # page and heading of the manual that explains the pane
    make: Callable[[], Any] = Service  # makes a Pane if there is a title, otherwise a Service
    part: Callable[[Workspace, Results], Part | None] = lambda _workspace, _results: None
    """Selects what the pane shows; None if there is nothing to show."""
    is_about_codes: bool = False  # whether the pane is empty while no code is sent
    updates_hidden: bool = False
    """Whether the pane is kept up to date while it is hidden, because other panes use it."""
    actions: Mapping[str, Callable[[], object]] = field(default_factory=dict)
    """Handlers of menu entries, by name."""
    commands: Mapping[str, Callable[[Any], object]] = field(default_factory=dict)
    """Handlers of further entries, called with the pane or service, which is made if needed."""
    enabled: Callable[[Workspace, Results], Mapping[str, bool]] = lambda _workspace, _results: {}
    """By name, whether the menu entries that are not always available can be chosen."""
    figures: tuple[Figure, ...] = ()
