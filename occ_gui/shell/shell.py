"""Shell: puts the declared features into docks and menus, and stops their work."""

from collections.abc import Mapping
from typing import Any, Protocol

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QAction, QHideEvent, QShowEvent
from PySide6.QtWidgets import QDockWidget, QVBoxLayout, QWidget

from occ_gui.core.store import Store
from occ_gui.shell.feature import Draw, Feature, Figure, NothingToDraw, Pane, Service
from occ_gui.shell.results import ResultsStore
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.modes import Places, Side
from occ_gui.widgets.building import fill, paragraph
from occ_gui.widgets.event_filters import leave_drops_to_window
from occ_model.scene.light_words import describe_light

_MARGIN = 12  # pixels around the sentence in place of a pane


class DockWindow(Protocol):
    @property
    def actions_by_name(self) -> Mapping[str, QAction]: ...

    def add_pane(
        self, name: str, title: str, content: QWidget, places: Places, default_side: Side
    ) -> QDockWidget:
        """Add a pane, and its entry in the view menu, before the window is shown."""


class Shell(QObject):
    """The declared features, each made when first needed, with their panes in docks."""

    made = Signal(str, object)  # a pane has been made: its name, and the Pane
    status_message = Signal(str)  # a sentence of one of the features for the status line
    file_failed = Signal(str)  # why one of the features did not open or save a file
    accepted = Signal()  # an allowed value was entered in one of the panes

    def __init__(self, store: Store, results_store: ResultsStore) -> None:
        super().__init__()
        self._store, self._results_store = store, results_store
        self._holders: dict[str, _PaneHolder] = {}
        self._service_features: dict[str, Feature[Any]] = {}
        self._services: dict[str, Service] = {}
        self._workspaces = store.select(lambda workspace: workspace)
        self._entries: list[tuple[Feature[Any], Mapping[str, QAction]]] = []
        self._workspaces.changed.connect(self.enable_entries)
        results_store.changed.connect(self.enable_entries)

    def add(self, feature: Feature[Any], window: DockWindow) -> None:
        if feature.title:
            holder = self._add_holder(feature)
            dock = window.add_pane(
                feature.name, feature.title, holder, feature.places, feature.default_side
            )
            dock.visibilityChanged.connect(holder.set_visible)
        else:
            self._service_features[feature.name] = feature
        self._entries.append((feature, window.actions_by_name))
        for name, handler in feature.actions.items():
            action = window.actions_by_name[name]
            action.triggered.connect(lambda _=False, handler=handler: handler())
        for name, command in feature.commands.items():
            window.actions_by_name[name].triggered.connect(
                lambda _=False, command=command: command(self.pane(feature.name))
            )

    def enable_entries(self) -> None:
        """Enable the menu entries that can be chosen now, once all have been added."""
        for feature, actions in self._entries:
            enabled = feature.enabled(self._store.workspace, self._results_store.results)
            for name, is_enabled in enabled.items():
                actions[name].setEnabled(is_enabled)
            if feature.is_about_codes:
                for figure in feature.figures:
                    actions[f"export_{figure.name}"].setEnabled(self._store.workspace.has_code)

    def embed(self, feature: Feature[Any]) -> QWidget:
        """Return a widget for a feature that is part of another pane, which shows and hides it."""
        holder = self._add_holder(feature)
        holder.shown.connect(holder.set_visible)
        return holder

    def _add_holder(self, feature: Feature[Any]) -> "_PaneHolder":
        holder = self._holders[feature.name] = _PaneHolder(feature, self)
        self._workspaces.changed.connect(holder.show_change)
        self._results_store.changed.connect(holder.show_change)
        return holder

    def pane(self, name: str) -> Any:
        """Return a pane or a service, which is made if needed."""
        if name in self._holders:
            return self._holders[name].make_pane()
        if name not in self._services:
            self._services[name] = self._service_features[name].make()
            self._services[name].status_message.connect(self.status_message)
            self._services[name].file_failed.connect(self.file_failed)
        return self._services[name]

    def find_pane(self, name: str) -> Any:
        """Return a pane or a service; None if it has not been made yet."""
        holder = self._holders.get(name)
        return holder.pane if holder else self._services.get(name)

    @property
    def help_pages(self) -> dict[str, str]:
        features = (holder.feature for holder in self._holders.values())
        return {feature.name: feature.help for feature in features if feature.help}

    @property
    def _figures(self) -> "dict[str, tuple[Figure, _PaneHolder]]":
        holders = self._holders.values()
        return {
            figure.name: (figure, holder) for holder in holders for figure in holder.feature.figures
        }

    @property
    def figures(self) -> dict[str, Figure]:
        return {name: figure for name, (figure, _) in self._figures.items()}

    @property
    def different_figures(self) -> list[Figure]:
        return [
            figure
            for figure, holder in self._figures.values()
            if not holder.is_unavailable and figure.differs_from_others(holder.pane)
        ]

    def draw(self, name: str, snapshot: Snapshot) -> Draw:
        """Return a function that draws a figure of these results; raises NothingToDraw."""
        figure, holder = self._figures[name]
        if holder.is_unavailable:
            raise NothingToDraw(holder.reason)
        return figure.draw(holder.pane, snapshot)

    @property
    def _services_and_panes(self) -> list[Service]:
        panes = (holder.pane for holder in self._holders.values())
        return [*(pane for pane in panes if pane is not None), *self._services.values()]

    @property
    def is_idle(self) -> bool:
        return all(work.is_idle for work in self._services_and_panes)

    @property
    def is_measured(self) -> bool:
        return all(work.is_measured for work in self._services_and_panes)

    def stop(self) -> None:
        for work in self._services_and_panes:
            work.stop()


class _PaneHolder(QWidget):
    shown = Signal(bool)

    def __init__(self, feature: Feature[Any], shell: Shell) -> None:
        super().__init__()
        self.feature, self._shell = feature, shell
        self._is_visible = False
        self._last_part: Any = None
        self.pane: Pane[Any] | None = None
        self._note = paragraph(name=feature.title)
        self._note.setMargin(_MARGIN)
        self._note.setAlignment(Qt.AlignmentFlag.AlignTop)
        self._note.hide()
        self._content = fill(QVBoxLayout(self), (self._note, 1), margins=0)

    @property
    def is_unavailable(self) -> bool:
        return self.feature.is_about_codes and not self._shell._store.workspace.has_code

    @property
    def reason(self) -> str:
        light = describe_light(self._shell._store.workspace.scene.transmitter)
        return (
            f"“{self.feature.title}” is about codes, and none is sent: {light}. Choose the light "
            "“code”, or look at its bars in the pane “Bars”."
        )

    def make_pane(self) -> Pane[Any]:
        if self.pane is None:
            pane: Pane[Any] = self.feature.make()
            self.pane = pane
            self._content.addWidget(pane.widget)
            pane.widget.setHidden(self.is_unavailable)
            pane.status_message.connect(self._shell.status_message)
            pane.file_failed.connect(self._shell.file_failed)
            pane.accepted.connect(self._shell.accepted)
            leave_drops_to_window(self)
            self._shell.made.emit(self.feature.name, pane)
            self.show_change()
        return self.pane

    def set_visible(self, visible: bool) -> None:
        self._is_visible = visible
        if visible and not self.is_unavailable:
            self.make_pane()
        self.show_change()
        if self.pane is not None:
            self.pane.set_visible(visible and not self.is_unavailable)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        super().showEvent(event)
        self.shown.emit(True)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 - Qt's name
        super().hideEvent(event)
        self.shown.emit(False)

    def show_change(self) -> None:
        """Show the part of the pane if it is visible and has changed, or why there is none."""
        is_unavailable, was_unavailable = self.is_unavailable, not self._note.isHidden()
        if is_unavailable:
            self._note.setText(self.reason)
        if is_unavailable != was_unavailable:
            self._note.setVisible(is_unavailable)
            if self.pane is not None:
                self.pane.widget.setHidden(is_unavailable)
            if self._is_visible:
                self.set_visible(True)
        is_updated = self._is_visible or self.feature.updates_hidden
        if is_unavailable or self.pane is None or not is_updated:
            return
        part = self.feature.part(self._shell._store.workspace, self._shell._results_store.results)
        if part is not None and part != self._last_part:
            self._last_part = part
            self.pane.show_part(part)
