"""Cards of the limits: the highest frequencies of the advice, searched for while visible."""

from dataclasses import replace

import pytest
from gui.detection_map.test_advice import BAD, GOOD, HIGHEST, INSIDE, advice_on, list_texts
from gui.kinds import add_widget
from pytestqt.qtbot import QtBot

from occ_gui.detection_map import limit_cards
from occ_gui.detection_map.advice_view import AdviceView
from occ_gui.detection_map.limit_cards import LimitCards
from occ_model.results.limit_text import format_value
from occ_model.results.limits import Advice, RangeEnd, ReadInterval
from occ_model.scene.scene import Scene
from occ_model.study.limits import advice_of


@pytest.fixture
def cards(qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> LimitCards:
    monkeypatch.setattr(limit_cards, "REST_MS", 5)
    return add_widget(qtbot, LimitCards(["threshold", "matched"]))


def with_end(scene: Scene, end: RangeEnd | None) -> Advice:
    """Return advice with this upper end of the range of frequencies."""
    limits = advice_on(scene).limits
    (interval,) = limits.frequency.intervals
    intervals = (replace(interval, highest=end),) if end else ()
    frequency = replace(limits.frequency, intervals=intervals)
    return advice_of(replace(limits, frequency=frequency))


def test_a_card_states_what_the_page_of_advice_states(qtbot: QtBot, small_scene: Scene) -> None:
    view = add_widget(qtbot, AdviceView(["threshold", "matched"]))
    cards = add_widget(qtbot, view.cards)
    view.use_frame_rate(12.0)
    view.show_advice(advice_on(small_scene))
    card = cards.cards["threshold"]
    assert card.value.text() == "14.55 kHz"
    assert "99 %" in card.name.toolTip()
    texts = list_texts(view)
    place = next(i for i, text in enumerate(texts) if text.startswith("It reads frequencies up"))
    sentence = " ".join(texts[place : place + 2])  # and how that is known
    assert card.value.toolTip() == sentence
    assert any("120 bits a second" in text for text in texts)
    assert card.range.toolTip() == "from 14.7 kHz"
    assert cards.cards["matched"].value.text() == ""
    limits = advice_on(small_scene).limits
    failing = replace(limits.frequency, faults="A plug-in failed.")
    view.show_advice(replace(advice_on(small_scene), limits=replace(limits, frequency=failing)))
    assert "A plug-in failed." in list_texts(view)
    assert card.range.toolTip() == "from 14.7 kHz; a plug-in failed"


def test_the_answer_states_what_the_cards_state_as_soon_as_it_is_known(
    cards: LimitCards, small_scene: Scene
) -> None:
    def of_matched(advice: Advice) -> Advice:
        return replace(advice, limits=replace(advice.limits, decoder="matched"))

    exposure = f"At {format_value('exposure_time', small_scene.camera.exposure_time)} the"
    answer, known = cards.answer, "paper's threshold decoder reads up to 14.55 kHz"
    assert answer.line.text() == ""
    cards.show_begun()
    assert answer.line.text() == "Searching for the highest frequency of threshold and matched."
    cards.show_advice(advice_on(small_scene))
    cards.show_rough("matched", advice_on(small_scene).limits.frequency)
    searching = "; still searching for the highest frequency of matched (roughly 14.55 kHz)."
    assert answer.line.text() == f"{exposure} {known}{searching}"
    note = "The threshold decoder's true end is between 14.55 kHz and 14.72 kHz (95 %)."
    assert answer.note.text() == note
    cards.show_advice(of_matched(with_end(small_scene, RangeEnd(INSIDE.value, INSIDE, None))))
    matched = cards.cards["matched"].value.text()
    assert matched == "14.55 kHz"
    beyond = f"{matched} (not searched beyond)"
    sentence = f"{exposure} {known}; the matched decoder up to {beyond}."
    assert (answer.line.text(), answer.note.text()) == (sentence, note)
    cards.show_begun()
    cards.show_advice(of_matched(with_end(small_scene, None)))
    cards.show_ended("Cancelled.")
    unread = f"{exposure} matched decoder reads at no frequency."
    assert (answer.line.text(), answer.note.text()) == (unread, "Cancelled.")


def test_where_nothing_is_read_the_card_says_why(cards: LimitCards, small_scene: Scene) -> None:
    cards.show_advice(replace(with_end(small_scene, None), cause="Overexposed. All is white."))
    card = cards.cards["threshold"]
    assert (card.value.text(), card.range.toolTip()) == ("none", "Overexposed. All is white.")
    assert card.value.toolTip() == "Overexposed. All is white."


def test_go_leads_to_where_every_bit_was_read(cards: LimitCards, small_scene: Scene) -> None:
    destinations: list[tuple[str, float, str]] = []
    cards.destination_chosen.connect(lambda *to: destinations.append(to))
    cards.show_advice(advice_on(small_scene))
    button = cards.cards["threshold"].go
    assert button.text() == "Go"  # to what the card states
    button.click()
    assert destinations == [("switching_frequency", HIGHEST[0], "threshold")]


def test_a_limit_without_an_end_is_marked_and_without_a_destination_the_button_is_disabled(
    cards: LimitCards, small_scene: Scene
) -> None:
    cards.show_advice(with_end(small_scene, RangeEnd(INSIDE.value, INSIDE, None)))
    card = cards.cards["threshold"]
    assert (card.name.text(), card.value.text()) == ("Threshold: at least", "14.55 kHz")
    assert card.range.toolTip() == "not searched beyond; from 14.7 kHz"
    assert "14.55 kHz (not searched beyond)" in card.value.toolTip()
    assert "14.55 kHz (not searched beyond)" in cards.answer.line.text()
    cards.show_advice(with_end(small_scene, RangeEnd(GOOD.value, GOOD, BAD)))
    assert not card.go.isEnabled()
    assert (card.name.text(), card.value.text()) == ("Threshold: up to", "about 14.7 kHz")


def test_what_is_read_beyond_gaps_is_named_behind_the_limit(
    cards: LimitCards, small_scene: Scene
) -> None:
    frequencies = advice_on(small_scene).limits.frequency
    low, high, far = (RangeEnd(value, GOOD, BAD) for value in (2e3, 14.55e3, 46.42e3))
    for others, end in ((1, "46.42 kHz"), (2, "and 1 more"), (3, "and 2 more")):
        beyond = [ReadInterval(far, far) for _ in range(others)]
        several = replace(frequencies, intervals=(ReadInterval(low, high), *beyond))
        cards.cards["threshold"].show_range(several)
        text = cards.cards["threshold"].range.toolTip()
        assert text.startswith("from 2 kHz; again at 46.42 kHz")
        assert text.endswith(end)


def test_visible_cards_request_limits_once_and_not_for_a_scene_that_returns(
    cards: LimitCards, small_scene: Scene, qtbot: QtBot
) -> None:
    cards.show_outdated(True)
    assert not cards.rest_timer.isActive()
    cards.show()
    assert cards.rest_timer.isActive()
    cards.hide()
    assert not cards.rest_timer.isActive()
    cards.show()
    with qtbot.waitSignal(cards.search_requested):
        pass
    assert not cards.rest_timer.isActive()
    card = cards.cards["threshold"]
    cards.show_begun()
    assert (card.value.text(), card.range.toolTip()) == ("waiting", "")
    cards.show_progress({"threshold": None})
    assert card.value.text() == "waiting"
    cards.show_progress({"threshold": 12, "a plug-in's": 3})
    assert (card.value.text(), card.range.toolTip()) == ("searching", "12 pictures tried")
    cards.show_rough("threshold", advice_on(small_scene).limits.frequency)
    assert card.range.toolTip() == ""  # one picture was tried at each frequency
    cards.show_progress({"threshold": 12})
    assert (card.value.text(), card.go.isEnabled()) == ("roughly 14.55 kHz", False)
    assert card.range.toolTip() == "12 pictures tried"
    cards.show_advice(advice_on(small_scene))
    cards.show_rough("threshold", advice_on(small_scene).limits.frequency)  # too late
    cards.show_progress({"threshold": 13})  # of the other decoders' search
    assert card.value.text() == "14.55 kHz"
    cards.show_ended()
    assert card.go.isEnabled()
    cards.show_outdated(True)
    assert cards.rest_timer.isActive()
    assert not card.go.isEnabled()
    assert cards.answer.line.text().startswith("Earlier scene: ")
    cards.show_outdated(False)
    assert not cards.rest_timer.isActive()
    with qtbot.waitSignal(cards.search_requested):
        cards.show_outdated(True)
    cards.show_outdated(False)
    cards.show()
    cards.show_begun()
    cards.show_ended("The scene has changed; ask again.")
    cards.show_outdated(True)
    cards.show_outdated(False)
    assert cards.rest_timer.isActive()


def test_a_search_that_fails_gives_the_reason(cards: LimitCards, small_scene: Scene) -> None:
    why = "A raw pattern has no code; a success rate needs packets."
    cards.show_begun()
    cards.show_ended(why)
    for card in cards.cards.values():
        assert (card.value.text(), card.value.toolTip()) == ("?", why)
        assert not card.go.isEnabled()
    assert cards.answer.line.text() == why
    cards.show_begun()
    cards.show_advice(advice_on(small_scene))
    cards.show_ended("Cancelled.")
    assert [card.value.text() for card in cards.cards.values()] == ["14.55 kHz", "?"]
    assert cards.answer.note.text().endswith(" Cancelled.")
