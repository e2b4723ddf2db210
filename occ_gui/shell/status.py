"""The sentence of the status line: the latest remark, for as long as it holds."""

from collections.abc import Callable
from typing import TypeAlias

from occ_gui.core.workspace import Workspace
from occ_gui.shell.results import Results
from occ_gui.values.remarks import Remark

Until: TypeAlias = Callable[[Workspace, Results], object]
"""Returns the part of the state that a sentence is about: it holds until that part changes."""


def next_sentence(_workspace: Workspace, _results: Results) -> object:
    return None


def entries_of(workspace: Workspace) -> tuple[object, ...]:
    """Return what the user enters: the scene, the settings, and fields of panes of their own."""
    film = workspace.film
    fields = (workspace.room, film.recording, film.frames, workspace.frame_rate)
    return (workspace.scene, workspace.settings, *fields)


def next_change(workspace: Workspace, _results: Results) -> object:
    return entries_of(workspace)


def next_picture(_workspace: Workspace, results: Results) -> object:
    return results.snapshot


def next_photo(_workspace: Workspace, results: Results) -> object:
    return results.photo


def next_match(_workspace: Workspace, results: Results) -> object:
    document = results.document
    return None if document is None else (document.photo, document.found)


def make_remark(sentence: str, until: Until, workspace: Workspace, results: Results) -> Remark:
    return Remark(sentence, until, until(workspace, results))


def status_message(workspace: Workspace, results: Results) -> str:
    """Return the sentence of the status line; empty where none holds any more."""
    last = results.remark
    if last is None or last.until(workspace, results) != last.state:
        return ""
    return last.sentence
