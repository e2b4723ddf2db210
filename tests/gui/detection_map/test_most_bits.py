"""The card of most bits states the model's result, and leads to a scene that is read."""

from collections.abc import Iterator
from dataclasses import replace

import pytest
from gui.conftest import InlineWorkers, LazyWorkers
from gui.kinds import show_widget
from gui.stores import show, store_of
from PySide6.QtCore import QTimer
from pytestqt.qtbot import QtBot

from occ_gui.background.signals import WorkQueue
from occ_gui.detection_map import advice_worker
from occ_gui.detection_map.most_bits_card import MostBitsCard
from occ_gui.detection_map.search_controller import MostBitsController
from occ_model.results.bit_errors import MostBits
from occ_model.scene.scene import Scene
from occ_model.study.most_bits import DECODERS, VARIED_PARAMETERS, reset_varied

LENGTHS = dict(zip(DECODERS, (112, 185, 40), strict=True))
"""Bits per picture that the fake decoders read."""


def result_of(decoder: str, scene: Scene, frames: float = 30.0) -> MostBits:
    sent = reset_varied(scene).replace(
        payload="bits:" + "0" * LENGTHS[decoder], switching_frequency=28.8e3
    )
    return MostBits(decoder, sent, 10, frames * LENGTHS[decoder], frames, 66)


def failure_of(decoder: str) -> MostBits:
    return MostBits(decoder, None, 10, 0.0, 30.0, 0, "None of 9 combinations was read.")


@pytest.fixture
def card(qtbot: QtBot) -> MostBitsCard:
    return show_widget(qtbot, MostBitsCard())


def buttons(card: MostBitsCard) -> set[str]:
    return {b.text() for b in (card.search, card.cancel, card.go) if b.isVisible()}


def test_the_card_searches_and_shows_the_best(card: MostBitsCard, small_scene: Scene) -> None:
    assert (
        card.text.toolTip() == "Which code, frequency and number of bits give the highest bit rate?"
    )
    assert buttons(card) == {"Search"}
    card.show_begun()
    card.show_progress("threshold", None)
    assert card.text.toolTip().endswith("searching with threshold")
    card.show_progress("threshold", 12)
    assert "searching with threshold, 12 pictures tried" in card.text.toolTip()
    assert buttons(card) == {"Cancel"}
    for decoder in DECODERS:
        card.show_result(result_of(decoder, small_scene))
    assert card.text.toolTip().startswith("So far: 5,550 bits a second")
    card.show_ended("")
    assert card.text.toolTip() == (
        "Highest bit rate: 5,550 bits a second: 185 bits in each picture, line code manchester, "
        "28.8 kHz, read by equalizer"
    )
    assert buttons(card) == {"Go"}


def test_a_cancelled_or_earlier_result_is_marked_and_none_gives_the_reason(
    card: MostBitsCard, small_scene: Scene
) -> None:
    card.show_begun()
    card.show_result(result_of("threshold", small_scene))
    card.show_ended("cancelled")
    assert card.text.toolTip().startswith("So far: 3,360 bits a second")
    assert card.text.toolTip().endswith("; cancelled")
    assert card.go.isEnabled()
    card.show_outdated(True)
    assert card.text.toolTip().startswith("Earlier scene: ")
    assert buttons(card) == {"Search", "Go"}
    assert not card.go.isEnabled()
    card.show_begun()
    card.show_result(replace(failure_of("threshold"), faults="A plug-in failed."))
    card.show_ended("")
    assert "threshold: None of 9 combinations was read. A plug-in failed." in card.text.toolTip()
    assert buttons(card) == {"Search"}


class Bench:
    """The controller with a scene and a card."""

    def __init__(self, scene: Scene, card: MostBitsCard, workers: InlineWorkers) -> None:
        self.scenes = store_of(scene)
        self.card, self.workers = card, workers
        self.queue = WorkQueue(1, lambda: workers)
        (channel,) = self.queue.channels
        self.controller = MostBitsController(self.scenes, self.queue, channel, card)
        card.search_requested.connect(self.controller.start)
        card.cancelled.connect(self.controller.cancel)
        card.chosen.connect(self.controller.go)


@pytest.fixture
def bench(
    small_scene: Scene,
    card: MostBitsCard,
    inline_workers: InlineWorkers,
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[Bench]:
    def most_bits(
        scene: Scene, decoders: tuple[str], *, frames_a_second: float, **_: object
    ) -> tuple[MostBits]:
        return (result_of(decoders[0], scene, frames_a_second),)

    monkeypatch.setattr(advice_worker, "most_bits", most_bits)
    bench = Bench(small_scene, card, inline_workers)
    yield bench
    bench.controller.cancel()
    bench.queue.stop()


def test_go_applies_the_result_in_one_step(bench: Bench, qtbot: QtBot) -> None:
    before = bench.scenes.scene
    bench.card.search.click()
    qtbot.waitUntil(lambda: bench.controller.channel.is_idle)
    assert len(bench.workers.jobs) == len(DECODERS)
    bench.card.go.click()
    scene = bench.scenes.scene
    assert bench.scenes.store.workspace.decoder == "equalizer"
    assert scene.transmitter.payload_length == LENGTHS["equalizer"]
    assert "1" in scene.transmitter.payload, "zeros alone are not typical of the payloads tried"
    values = {name: before.value(name) for name in VARIED_PARAMETERS}
    assert scene.replace(**values) == before
    assert bench.card.go.isEnabled(), "the result does not depend on the values that it sets"
    bench.scenes.undo_stack.undo()
    assert bench.scenes.scene == before


def test_progress_after_the_last_decoder_changes_nothing(bench: Bench, qtbot: QtBot) -> None:
    bench.card.search.click()
    qtbot.waitUntil(lambda: bench.controller.channel.is_idle)
    before = bench.card.text.toolTip()
    (timer,) = bench.controller.findChildren(QTimer)
    with qtbot.captureExceptions() as raised:
        timer.timeout.emit()
    assert raised == []
    assert bench.card.text.toolTip() == before


@pytest.mark.parametrize(
    ("heartbeats", "said"),
    [(0, "searching with"), (1, "0 pictures tried"), (13, "12 pictures tried")],
)
def test_the_beginning_of_a_search_is_no_picture(bench: Bench, heartbeats: int, said: str) -> None:
    bench.card.show_begun()
    bench.controller._show_progress([heartbeats])
    assert said in bench.card.text.toolTip()


def test_another_distance_or_frame_rate_outdates_the_result(bench: Bench, qtbot: QtBot) -> None:
    bench.card.search.click()
    qtbot.waitUntil(lambda: bench.controller.channel.is_idle)
    show(bench.scenes.store, frame_rate=24.0)
    assert not bench.card.go.isEnabled()
    show(bench.scenes.store, frame_rate=30.0)
    assert bench.card.go.isEnabled()
    bench.scenes.change(distance=1.7)
    assert not bench.card.go.isEnabled()


def test_more_pictures_than_can_be_read_out_are_not_counted(small_scene: Scene) -> None:
    frame_rates = list[float]()

    def most_bits(*_: object, frames_a_second: float, **__: object) -> tuple[int]:
        frame_rates.append(frames_a_second)
        return (0,)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(advice_worker, "most_bits", most_bits)
        advice_worker.search_most_bits(small_scene, "threshold", 1e4, lambda: None)
    camera = small_scene.camera
    assert frame_rates == pytest.approx([1.0 / (camera.columns * camera.readout_time)])


def test_a_search_is_cancelled_by_the_user_or_by_another_scene(
    small_scene: Scene, card: MostBitsCard
) -> None:
    bench = Bench(small_scene, card, LazyWorkers())
    for end in (card.cancel.click, lambda: bench.scenes.change(distance=1.7)):
        card.search.click()
        assert not bench.controller.channel.is_idle
        end()
        assert bench.controller.channel.is_idle
        assert "Search" in buttons(card)
    bench.queue.stop()
