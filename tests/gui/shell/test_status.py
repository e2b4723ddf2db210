"""The sentence of the status line follows from workspace and results."""

from dataclasses import replace
from pathlib import Path

import pytest
from gui.kinds import SnapshotOf

from occ_gui.core.workspace import Workspace
from occ_gui.shell.results import (
    Results,
    StateSelector,
    make_remark,
    next_change,
    next_match,
    next_photo,
    next_picture,
    next_sentence,
    status_message,
)
from occ_gui.values.choices import LoadOptions, PhotoSource
from occ_gui.values.photo_results import MatchOutcome, PhotoDocument
from occ_model.photo.reading.load import Photo
from occ_model.scene.scene import Scene

SENTENCE = "Iso is 0; allowed: 1 to 2."


def states(photo: Photo, snapshot_of: SnapshotOf) -> dict[str, tuple[Workspace, Results]]:
    """Return a state, and other states that each differ from it in one thing."""
    source = PhotoSource(Path("a.png"), LoadOptions(), 1)
    document = PhotoDocument(photo, source)
    workspace, results = Workspace(Scene()), Results(document=document)
    found = replace(
        document, outcome=MatchOutcome(None, None, ("switching_frequency", 1e4), ("No.",))
    )
    return {
        "nothing": (workspace, results),
        "pane": (replace(workspace, is_enhanced=True), replace(results, listed=None)),
        "scene": (replace(workspace, scene=Scene().replace(iso=200.0)), results),
        "settings": (replace(workspace, settings=replace(workspace.settings, seed=9)), results),
        "frame rate": (replace(workspace, frame_rate=25.0), results),
        "picture": (workspace, replace(results, snapshot=snapshot_of())),
        "match": (workspace, replace(results, document=found)),
        "photo": (workspace, replace(results, document=replace(document, photo=replace(photo)))),
    }


@pytest.mark.parametrize(
    ("until", "ends"),
    [
        (next_sentence, set[str]()),
        (next_change, {"scene", "settings", "frame rate"}),
        (next_picture, {"picture"}),
        (next_photo, {"photo"}),
        (next_match, {"match", "photo"}),
    ],
)
def test_a_sentence_holds_until_what_it_is_about_changes(
    until: StateSelector, ends: set[str], photo: Photo, snapshot_of: SnapshotOf
) -> None:
    all_states = states(photo, snapshot_of)
    last = make_remark(SENTENCE, until, *all_states["nothing"])
    shown = {
        name: status_message(workspace, replace(results, remark=last))
        for name, (workspace, results) in all_states.items()
    }
    assert shown == {name: "" if name in ends else SENTENCE for name in all_states}
    assert status_message(*all_states["nothing"]) == ""
