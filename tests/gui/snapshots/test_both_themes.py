"""Verdicts, cards, story and timeline look like their stored pictures, in both themes.

See test_panes for renewing them.
"""

from typing import Any

import numpy as np
import pytest
from gui.kinds import SnapshotOf
from gui.photo.photo_bench import shown_photo
from gui.snapshots.gallery import Gallery
from matches import match_with
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget

from occ_gui.detection_map.limit_cards import LimitCards
from occ_gui.photo.photo_verdict import PhotoVerdictBar
from occ_gui.simulation.snapshot import Picture
from occ_gui.story.story_view import StoryView
from occ_gui.video.film_reading import MarkLegend, Marks, frame_marks
from occ_gui.video.timeline import Timeline
from occ_gui.widgets.state_look import State
from occ_gui.window.style_sheet import style_sheet
from occ_gui.window.theme import palette_of
from occ_model.photo.reading.load import Photo
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.scene.scene import Scene


@pytest.fixture
def theme(request: pytest.FixtureRequest) -> str:
    QApplication.setPalette(palette_of(request.param))
    return str(request.param)


def trial(frequency: float, right: int) -> Trial:
    return Trial(frequency, right, 100, float(right), float(right), 10, right // 10)


@pytest.mark.parametrize(
    ("name", "theme", "reasons"),
    [
        ("sure", "dark", ()),
        ("doubtful", "light", ("Only 1.2 periods of 4 chips are in view; 3 are needed.",)),
    ],
    indirect=["theme"],
)
def test_the_verdict_on_a_photo_looks_as_stored(
    gallery: Gallery,
    small_scene: Scene,
    photo: Photo,
    theme: str,
    name: str,
    reasons: tuple[str, ...],
) -> None:
    bar = gallery.show(PhotoVerdictBar(), 820, 50)
    match = match_with(scene=small_scene, reasons=reasons)
    scene = match.scene if name == "sure" else match.scene.replace(iso=50.0)
    bar.show_photo(shown_photo(photo, scene, match))
    bar.show_simulation(State.BAD, "Simulation: no code: no header found")
    bar.resize(820, bar.sizeHint().height())  # as high as its lines, as a layout makes it
    gallery.compare(bar, f"photo-verdict-{name}-{theme}")


@pytest.mark.parametrize("theme", ["light", "dark"], indirect=True)
def test_the_cards_of_the_limits_look_as_stored(gallery: Gallery, theme: str) -> None:
    cards = LimitCards(("threshold", "matched", "equalizer"))
    cards.setStyleSheet(style_sheet(palette_of(theme)))
    gallery.show(cards, 760, cards.sizeHint().height())
    read = RangeEnd(14.1e3, trial(14.1e3, 100), trial(14.3e3, 0), (14.1e3, 14.2e3))
    cards.cards["threshold"].show_limit(read, "It reads up to 14.2 kHz.")
    fails = trial(14.3e3, 0)
    ends = RangeEnd(3.5e3, trial(3.5e3, 100), None), RangeEnd(14.2e3, trial(14.2e3, 100), fails)
    cards.cards["threshold"].show_range(
        WorkingRange(
            "switching_frequency", (500.0, 100e3), 1.15, trial(10e3, 100), (ReadInterval(*ends),)
        )
    )
    cards.cards["matched"].show_searching()
    cards.cards["equalizer"].show_limit(None, "It reads at no frequency.")
    gallery.compare(cards, f"limit-cards-{theme}")


MISREAD: dict[str, Any] = {"exposure_time": 136e-6, "switching_frequency": 16e3}


@pytest.mark.parametrize(
    ("name", "theme", "changes"),
    [("read", "dark", {}), ("misread", "light", MISREAD)],
    indirect=["theme"],
)
def test_the_story_looks_as_stored(
    gallery: Gallery, snapshot_of: SnapshotOf, theme: str, name: str, changes: dict[str, Any]
) -> None:
    view = gallery.show(StoryView(QWidget(), ("threshold", "matched")), 820, 560)
    snapshot = snapshot_of(**changes)
    view.show_picture(Picture(snapshot.frame, snapshot.request))
    view.show_reading(snapshot)
    gallery.compare(view, f"story-{name}-{theme}")


def frames() -> Marks:
    states = np.array([1] * 9 + [2] * 4 + [3] * 5 + [1] * 6 + [0] * 16, dtype=np.uint8)
    return frame_marks(np.arange(len(states)) / 30.0, states, 1 / 30.0)


def packets(count: int) -> Marks:
    """Return packets from the film's begin to its middle."""
    starts = np.linspace(0.0, 0.7, count, endpoint=False)
    states = np.array([1, 1, 3, 1, 2], dtype=np.uint8)[np.arange(count) % 5]
    return Marks(starts, starts + 0.7 / count, states)


@pytest.mark.parametrize(
    ("name", "theme", "count"), [("few", "light", 20), ("many", "dark", 900)], indirect=["theme"]
)
def test_the_timeline_looks_as_stored(gallery: Gallery, theme: str, name: str, count: int) -> None:
    pane, timeline = QWidget(), Timeline()
    layout = QVBoxLayout(pane)
    layout.addWidget(MarkLegend())
    layout.addWidget(timeline)
    gallery.show(pane, 640, 130)
    timeline.show_frames(frames())
    timeline.show_packets(packets(count))
    timeline.show_index(15)
    gallery.compare(pane, f"timeline-{name}-{theme}")
