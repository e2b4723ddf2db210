"""Feature: all that the window has to know of a pane."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Generic, TypeVar

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from occ_gui.background.task import Task
from occ_gui.core.workspace import Workspace
from occ_gui.shell.figures import Figure
from occ_gui.shell.results import MadeOf, Results

Part = TypeVar("Part")


class Pane(QObject, Generic[Part]):
    """What is made of a feature when its pane is first seen: a widget, and its connections.

    A pane that computes nothing in the background only has to show its part.
    """

    made_of: Mapping[QWidget, MadeOf] = MappingProxyType({})
    """What is marked while that of which it is made is of an earlier scene."""

    tasks: tuple[Task[Any, Any], ...] = ()
    """The work that the pane waits for, and that ends with it."""

    def __init__(self, widget: QWidget) -> None:
        super().__init__()
        self.widget = widget

    def show_part(self, part: Part) -> None:
        """Show this part of workspace and results in place of the last one."""

    def set_seen(self, seen: bool) -> None:
        """Take note whether the pane is seen; parts are shown only while it is."""

    @property
    def is_idle(self) -> bool:
        """Whether nothing is at work."""
        return all(task.is_idle for task in self.tasks)

    @property
    def is_measured(self) -> bool:
        """Whether all is measured that nobody waits for as for a picture."""
        return True

    def stop(self) -> None:
        """End all work; nothing is shown any more."""
        for task in self.tasks:
            task.stop()


@dataclass(frozen=True, kw_only=True)
class Feature(Generic[Part]):
    """A pane of the window.

    ``make`` is called when the pane is first seen: what is heavy is imported there.
    """

    name: str
    title: str
    help: str
    """Page and heading of the manual that explain the pane."""
    make: Callable[[], Pane[Part]]
    part: Callable[[Workspace, Results], Part | None] = lambda _workspace, _results: None
    """What of the window the pane shows; None for nothing that it could show."""
    goes_on_hidden: bool = False
    """Whether the pane shows its part while it is hidden, too: others look at what it shows."""
    actions: Mapping[str, Callable[[], object]] = field(default_factory=dict)
    """What the entries of the menus do that belong to the pane, by name."""
    figures: tuple[Figure, ...] = ()
