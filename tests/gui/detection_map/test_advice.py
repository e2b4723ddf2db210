"""The advice states the limits that the model's search finds, and leads to them."""

import re
from concurrent.futures import Future
from dataclasses import replace
from typing import Any

import pytest
from gui.conftest import InlineWorkers
from gui.detection_map.conftest import MapBench
from gui.kinds import add_widget, show_widget
from PySide6.QtCore import QPoint, QTimer
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot

from occ_gui.detection_map import advice_worker, map_schedule, search_controller as module
from occ_gui.detection_map.advice_sentences import make_advice_lines
from occ_gui.detection_map.advice_view import AdviceView
from occ_gui.widgets.answer import MoreButton
from occ_model.commands.limits import format_row, sentences
from occ_model.parallel.job import Job, JobResult
from occ_model.receiver.decode import DECODERS
from occ_model.results.limits import (
    Advice,
    Limits,
    RangeEnd,
    ReadInterval,
    TheoryLimits,
    Trial,
    WorkingRange,
)
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.limits import advice_of

# Value, right and sent bits, 95 % interval of their rate in percent, images, images without error.
GOOD = Trial(14.7e3, 198, 200, 81.9, 99.7, 20, 19)
INSIDE = Trial(14.55e3, 1000, 1000, 96.3, 100.0, 100, 100)
HIGHEST, LONGEST = (14.55e3, 14.72e3), (194e-6, 196.6e-6)  # 95 % intervals of the upper ends
BAD = Trial(14.73e3, 0, 200, 0.0, 16.1, 20, 0)
SHORT = Trial(10e-6, 200, 200, 83.9, 100.0, 20, 20)
UNREAD = Trial(10e3, 0, 200, 0.0, 16.1, 20, 0)
LONG = Trial(194e-6, 200, 200, 83.9, 100.0, 20, 20)
TOO_LONG = Trial(197e-6, 180, 200, 85.1, 93.4, 20, 18)


def find_limits(scene: Scene, decoder: str = "threshold", **_: Any) -> Limits:
    own = Trial(10e3, 200, 200, 83.9, 100.0, 20, 20)
    lowest, highest = RangeEnd(GOOD.value, GOOD, None), RangeEnd(HIGHEST[0], INSIDE, BAD, HIGHEST)
    shortest = RangeEnd(SHORT.value, SHORT, None)
    longest = RangeEnd(LONGEST[0], LONG, TOO_LONG, LONGEST)
    ranges = [
        WorkingRange(name, searched, 1.15, own, (ReadInterval(*ends),))
        for name, searched, ends in (
            ("switching_frequency", (500.0, 100e3), (lowest, highest)),
            ("exposure_time", (1e-5, 2e-3), (shortest, longest)),
        )
    ]
    return Limits(scene, decoder, 99.0, 20, 1, *ranges)


def list_texts(view: AdviceView) -> list[str]:
    return [label.text() for line in view.lines for label in line.findChildren(QLabel)]


def advice_on(scene: Scene) -> Advice:
    """Return limits of a scene, with theoretical ones of another."""
    frequencies = TheoryLimits(7353.0, 14706.0, two_packets=3468.0)
    exposures = TheoryLimits(100e-6, 200e-6, saturation=1.17e-3)
    return Advice(find_limits(scene), frequencies, exposures)


@pytest.fixture
def view(qtbot: QtBot) -> AdviceView:
    view = show_widget(qtbot, AdviceView())
    add_widget(qtbot, view.cards)  # which stand elsewhere
    return view


@pytest.fixture
def advice_bench(
    qtbot: QtBot, map_bench: MapBench, inline_workers: Any, monkeypatch: pytest.MonkeyPatch
) -> MapBench:
    """Ask for advice, and wait for it."""
    map_bench.workers = inline_workers
    monkeypatch.setattr(advice_worker, "limits", find_limits)
    monkeypatch.setattr(
        advice_worker, "rough_range", lambda scene, *_: find_limits(scene).frequency
    )
    monkeypatch.setattr(map_bench.pane.map, "set_visible", lambda _: None)  # not tested here
    map_bench.see("map")
    map_bench.view.advise.click()
    qtbot.waitUntil(lambda: map_bench.pane.advisor.channel.is_idle)
    return map_bench


def test_the_sentences_hold_value_bits_interval_limit_and_theory(small_scene: Scene) -> None:
    lines = [
        f"{each.text} {each.detail}".strip() for each in make_advice_lines(advice_on(small_scene))
    ]
    assert lines[1].startswith(
        "It reads frequencies down to about 14.7 kHz (not searched beyond); "
    )
    assert lines[2] == (
        "It reads frequencies up to 14.55 kHz. The end is between 14.55 kHz and "
        "14.72 kHz (95 %): there it read every bit of 100 images, at 14.73 kHz 0 % in 20 images "
        "(0.0 to 16.1 %)."
    )
    assert lines[5].startswith("It reads exposures down to 10 µs (not searched beyond). ")
    assert "it was not searched beyond" in lines[5]
    assert lines[6].startswith("It reads exposures up to 194 µs. ")
    assert lines[8] == (
        f"At 10 kHz it read 20 of 20 pictures of code {small_scene.transmitter.code}, 100 % of the "
        f"bits (83.9 to 100.0 %): 300 bits a second, if other codes are read as well."
    )
    assert "Below 3.468 kHz a picture does not contain" in lines[3]
    assert "ends at 7.353 kHz and an alternating pattern at 14.71 kHz" in lines[4]
    assert "ends at 100 µs and an alternating pattern at 200 µs" in lines[7]
    assert "above 1.17 ms, completely lit columns are saturated" in lines[7]


def test_the_limits_end_at_the_first_gap_and_intervals_beyond_it_follow_them(
    small_scene: Scene,
) -> None:
    limits = advice_on(small_scene).limits
    (wide,) = limits.exposure.intervals
    trials = [replace(LONG, value=value) for value in (3e-6, 5e-6, 233e-6, 233.01e-6)]
    fast, slow, low, high = (RangeEnd(trial.value, trial, TOO_LONG) for trial in trials)
    intervals = (ReadInterval(fast, slow), wide, ReadInterval(low, high))
    exposure = replace(limits.exposure, intervals=intervals)
    found = replace(limits, exposure=exposure)
    assert (found.shortest_exposure, found.longest_exposure) == (10e-6, 194e-6)
    texts = [line.text for line in make_advice_lines(advice_of(found))]
    place = texts.index("It reads exposures up to 194 µs.")
    assert texts[place + 1] == "With gaps between, it also reads from 3 µs to 5 µs; at 233 µs."
    row, lines = format_row(found), sentences([found])
    assert "10 µs (not searched beyond)      194 µs  " in row
    assert "from 3 µs to 5 µs and 1 more" in row
    assert lines.count("  beyond a gap:") == 2


def test_an_end_without_a_sure_value_has_no_destination(small_scene: Scene) -> None:
    advice = advice_on(small_scene)
    frequencies = advice.limits.frequency
    (interval,) = frequencies.intervals
    interval = replace(interval, highest=replace(interval.highest, interval=None))
    only = replace(frequencies, intervals=(interval,))
    doubtful = replace(advice, limits=replace(advice.limits, frequency=only))
    line = make_advice_lines(doubtful)[2]
    assert line.text.endswith("; no value within is sure to be read.")
    assert line.destination is None


def test_where_nothing_is_read_the_models_sentence_is_shown(small_scene: Scene) -> None:
    best = Trial(2e3, 120, 200, 53.1, 66.5, 20, 12)
    ranges = [
        WorkingRange(name, searched, 1.15, best, (), "The model's sentence.", best)
        for name, searched in (("switching_frequency", (500.0, 100e3)), ("exposure_time", (1, 3)))
    ]
    limits = Limits(small_scene, "threshold", 99.0, 20, 1, *ranges)
    lines = make_advice_lines(advice_of(limits))
    assert lines[1].text == (
        "It reads 99 % of the bits at no switching frequency from 500 Hz to 100 kHz. The most it "
        "reads is 120 of 200 bits, at 2 kHz."
    )
    assert any("at no exposure time from 1 s to 3 s" in line.text for line in lines)
    assert all(line.destination is None for line in lines)


def test_the_cause_of_an_unread_scene_comes_first_in_window_and_shell(
    small_scene: Scene,
) -> None:
    white = small_scene.replace(exposure_time=136e-6, iso=12800.0)
    limits = find_limits(white)
    limits = replace(limits, frequency=replace(limits.frequency, own=UNREAD))
    advice = advice_of(limits)
    assert advice.cause.startswith("Overexposed. The lit panel would have the level 860.6")
    text = f"does not read the scene as it is. {advice.cause}"
    assert make_advice_lines(advice)[1].text == f"It {text}"
    assert sentences([limits])[0] == f"The threshold decoder {text}"
    assert advice_of(find_limits(small_scene)).cause == ""


def test_window_and_shell_state_the_same_numbers(small_scene: Scene) -> None:
    advice = advice_on(small_scene)
    shell = " ".join([format_row(advice.limits), *sentences([advice.limits])])
    for line in make_advice_lines(advice):
        if line.destination is not None:
            assert line.destination[2] in shell
            assert all(text in shell for text in re.findall(r"\d+ % in \d+ images", line.detail))
    (bits,) = re.findall(r"%\): (\S+) bits a second", " ".join(
        line.text for line in make_advice_lines(advice)))  # fmt: skip
    assert format_row(advice.limits).split()[-1] == bits


def test_every_decoder_is_searched_and_each_end_has_a_button(advice_bench: MapBench) -> None:
    advice = advice_bench.view.advice
    titles = [text for text in list_texts(advice) if text.startswith("The ")]
    for decoder in DECODERS:
        assert any(title.startswith(f"The {decoder} decoder, 99 %") for title in titles)
    assert len(advice.destinations) == 3 * len(DECODERS)
    details = [part for part in advice.content.findChildren(QLabel) if "images" in part.text()]
    assert not any(part.isVisible() for part in details)
    for more in advice.findChildren(MoreButton):
        more.click()
    assert all(part.isVisible() for part in details)
    assert advice.search_again.isVisible()


def test_the_page_opens_with_what_is_known_and_does_not_search_for_it_again(
    advice_bench: MapBench,
) -> None:
    view, texts = advice_bench.view, list_texts(advice_bench.view.advice)
    view.advice.back.click()
    view.advise.click()
    assert advice_bench.pane.advisor.channel.is_idle
    assert list_texts(view.advice) == texts
    advice_bench.scenes.change(iso=200.0)
    view.advice.back.click()
    view.advise.click()
    assert not advice_bench.pane.advisor.channel.is_idle


def test_a_running_search_that_the_user_asks_for_keeps_what_it_has_found(
    qtbot: QtBot, map_bench: MapBench
) -> None:
    map_bench.workers = workers = EndlessWorkers()
    view, advisor = map_bench.view, map_bench.pane.advisor
    view.cards.search_requested.emit()
    qtbot.waitUntil(lambda: bool(workers.jobs))
    scene = map_bench.scenes.scene
    rough = [
        advice_worker.RoughAnswer(decoder, find_limits(scene).frequency)
        for decoder in [*DECODERS][:2]
    ]
    advisor.channel.results_ready.emit(None, [*rough, advice_on(scene)])
    first, *others = (
        text for text in list_texts(view.advice) if text.startswith("The ") and "rough" in text
    )
    assert first.startswith(
        f"The {[*DECODERS][1]} decoder reads frequencies up to roughly 14.55 kHz"
    )
    assert not others
    texts, count = list_texts(view.advice), len(workers.jobs)
    view.advise.click()
    qtbot.waitUntil(lambda: len(workers.jobs) > count)
    assert list_texts(view.advice) == texts
    assert "threshold" not in {job.arguments[2] for job in workers.jobs[count:]}
    count = len(workers.jobs)
    view.advise.click()
    assert len(workers.jobs) == count


def test_a_destination_button_changes_the_scene_in_one_step(advice_bench: MapBench) -> None:
    before = advice_bench.scenes.scene
    for place, text, name, value in (
        (0, "Go to 14.55 kHz", "switching_frequency", 14.55e3),
        (1, "Go to 10 µs", "exposure_time", 10e-6),
        (2, "Go to 194 µs", "exposure_time", 194e-6),
    ):
        advice_bench.choose_decoder("matched")
        button = [*advice_bench.view.advice.destinations][place]
        assert button.text() == text
        button.click()
        assert advice_bench.scenes.scene == before.replace(**{name: value})
        assert advice_bench.store.workspace.decoder == "threshold", "the decoder of the limit"
        label = quantity(name).label.lower()
        assert advice_bench.view.advice.state.toolTip() == (
            "This advice is for the scene before the change. "
            f"Its limits for the {label} still hold."
        )
        advice_bench.scenes.undo_stack.undo()
        assert advice_bench.scenes.scene == before


def test_a_refusal_of_the_model_is_shown(
    qtbot: QtBot, advice_bench: MapBench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.undo()
    advice_bench.scenes.change(pattern="1100")
    advice_bench.view.advice.search_again.click()
    qtbot.waitUntil(lambda: advice_bench.pane.advisor.channel.is_idle)
    assert "A raw pattern has no code" in advice_bench.view.advice.state.toolTip()


class EndlessWorkers(InlineWorkers):
    """Workers that do not end before their work is abandoned."""

    def __init__(self) -> None:
        super().__init__()
        self.futures: list[Future[JobResult]] = []

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        self.jobs.append(job)
        self.futures.append(Future())
        return self.futures[-1]

    def abandon(self, channel: int, run: int) -> None:
        while self.futures:
            self.futures.pop().set_result(JobResult(is_abandoned=True))


def test_a_search_ends_when_it_is_cancelled_the_scene_changes_or_the_window_stops(
    qtbot: QtBot, map_bench: MapBench, monkeypatch: pytest.MonkeyPatch
) -> None:
    map_bench.workers = EndlessWorkers()
    monkeypatch.setattr(module, "PROGRESS_MS", 5)
    advice, advisor = map_bench.view.advice, map_bench.pane.advisor
    for end, text in (
        (advice.cancel.click, "Cancelled."),
        (lambda: map_bench.scenes.change(iso=200.0), "The scene has changed; ask again."),
    ):
        advisor.start()
        assert not advisor.channel.is_idle
        end()
        assert advisor.channel.is_idle
        assert advice.state.toolTip() == text
    map_bench.view.advise.click()
    timers = advisor.findChildren(QTimer)
    assert any(timer.isActive() for timer in timers)
    map_bench.shell.stop()
    qtbot.waitUntil(lambda: not any(timer.isActive() for timer in timers))


def test_only_a_search_that_the_user_starts_comes_before_the_map(
    qtbot: QtBot, map_bench: MapBench
) -> None:
    map_bench.workers = workers = EndlessWorkers()
    map_bench.view.cards.search_requested.emit()
    qtbot.waitUntil(lambda: bool(workers.jobs))
    in_turn = workers.jobs[0].rank
    map_bench.view.advise.click()
    qtbot.waitUntil(lambda: workers.jobs[-1].rank < map_schedule.COARSE)
    assert map_schedule.FINE < in_turn < map_schedule.MORE_IMAGES


def test_sentences_about_every_decoder_are_shown_once_at_the_end(
    view: AdviceView, small_scene: Scene
) -> None:
    for decoder in ("threshold", "matched"):
        advice = advice_on(small_scene)
        view.show_advice(replace(advice, limits=replace(advice.limits, decoder=decoder)))
    for more in view.findChildren(MoreButton):
        more.click()
    QApplication.processEvents()
    labels = [label for row in view.lines for label in row.findChildren(QLabel) if label.text()]
    labels.sort(key=lambda label: label.mapTo(view.content, QPoint()).y())
    texts = [label.text() for label in labels]
    common = texts.index("For every decoder")
    assert [text for text in texts[common:] if text in texts[:common]] == []
    assert sum("By theory" in text for text in texts) == 2
    assert all("By theory" not in text for text in texts[:common])
    titles = [text for text in texts[:common] if " decoder, " in text]
    assert [title.split()[1] for title in titles] == ["threshold", "matched"]


def test_outdated_advice_is_dimmed_and_leads_only_to_valid_limits(advice_bench: MapBench) -> None:
    advice = advice_bench.view.advice

    def state() -> tuple[set[bool], list[bool]]:
        labels = {each.isEnabled() for row in advice.lines for each in row.findChildren(QLabel)}
        first = [button.isEnabled() for button in [*advice.destinations][:3]]
        assert {card.go.isEnabled() for card in advice.cards.cards.values()} == {first[0]}
        return labels, first

    assert state() == ({True}, [True, True, True])
    advice_bench.scenes.change(switching_frequency=9e3)  # its limits do not depend on it
    assert state() == ({True, False}, [True, False, False])
    first = next(iter(advice.destinations))
    (row,) = [row for row in advice.lines if first in row.children()]
    assert all(label.isEnabled() for label in row.findChildren(QLabel))
    advice_bench.scenes.change(iso=200.0)
    assert state() == ({False}, [False, False, False])
    advice_bench.scenes.undo_stack.undo()
    advice_bench.scenes.undo_stack.undo()
    assert state() == ({True}, [True, True, True])
    advice_bench.view.image_effects.click()
    assert state() == ({False}, [False, False, False])
