"""A quantity that several panes state has one value: what they show is gathered and compared.

Each number stands for the values that round to it; those of one quantity must have one in common.
"""

import re
from collections import defaultdict
from collections.abc import Iterator
from typing import Any

import pytest
from amount import amount
from gui.user import User
from gui.visible_texts import visible_texts
from PySide6.QtWidgets import QWidget

from occ_gui.app.application import Application
from occ_gui.window.status_line import StatusLine
from occ_model.scene.units import HERTZ, NONE, PERCENT, SECOND, Unit

_PAST = {"exposure_time": 136e-6, "switching_frequency": 10e3}
_LAMP = {"light": "lamp", "lamp_frequency": 1700.0, "duty": 0.3}

SCENES: dict[str, dict[str, Any]] = {
    "past the period": _PAST,
    "lamp": _LAMP,
    "slow": {"switching_frequency": 3210.0},
    "weak bars": {**_LAMP, "depth": 0.02, "exposure_time": 4e-4},
    "dark": {"luminance": 5.0},
    "lens": {"vignetting_exponent": 2.0, "edge_time": 5e-6, "luminance": 500.0},
    "near the null": {**_PAST, "switching_frequency": 14.5e3},
    "far past": {"exposure_time": 333e-6, "switching_frequency": 12.34e3, "iso": 50.0},
    "far": {"distance": 2.0, "code": 5},
    "no bars": {**_LAMP, "exposure_time": 1 / 1700.0},
    "mains": {"light": "mains", "exposure_time": 2e-3, "iso": 50.0},
    "pulses": {"light": "pulses", "pulse_frequency": 900.0, "pulse_length": 2e-4},
    "at the period": {"exposure_time": 100e-6, "switching_frequency": 10e3},
}
PANES = ("decode", "equations", "bands", "profile", "spectrum", "accuracy")

_N = r"(-?[\d.,]+(?:e-?\d+)?) ?"
_T, _F = _N + "(s|ms|µs|ns)", _N + "(Hz|kHz|MHz)"

STATEMENTS: dict[str, tuple[Unit, tuple[str, ...]]] = {
    "exposure over period": (
        NONE,
        (rf"t / t ?LED = {_N}()", rf"at {_N}() chips an exposure", rf"t / period = {_N}()"),
    ),
    "band model's end": (
        HERTZ,
        (
            rf"{_F}: Exposure and switching period are equal",
            rf"first zero of the exposure's response: {_F}",
        ),
    ),
    "first null": (
        HERTZ, (rf"{_F}: The exposure is two chips long", rf"= {_F}; here, at"),
    ),
    "level in the column": (NONE, (rf"·  level {_N}()", rf"→ {_N}() grey levels")),
    "lit time": (SECOND, (rf"·  lit for {_T} of", rf"LED on for {_T} \(")),
    "depth of the bars": (
        PERCENT,
        (
            rf"(?:[Tt]he bars|They) are {_N}(%) of the mean",
            rf"(?:Bars of {_N}(%) of the mean|No bars at [^:]*: {_N}(%))",
        ),
    ),
    "columns from bar to bar": (
        NONE, (rf"{_N}() columns from bar to bar", rf"/ tr = [^=]*?{_N}() columns Time to read"),
    ),
    "code": (NONE, (r"Code (\d+)() read",)),
    "wrong bits": (NONE, (r", (\d+)() wrong$", r"read, (\d+)() of \d+ bits wrong")),
}  # fmt: skip


def texts_of(application: Application, user: User) -> Iterator[str]:
    """Yield the texts of the story, and of each pane once it is in front."""
    user.switch("explore")
    yield from map(strip_markup, visible_texts(application.window))
    yield from (strip_markup(badge.text) for badge in application.story.verdict.badges.badges)
    for pane in PANES:
        user.bring_to_front(pane)
        dock: QWidget = application.window.docks[pane]
        yield from map(strip_markup, visible_texts(dock))
        application.window.hide_pane(pane)


def strip_markup(text: str) -> str:
    return " ".join(re.sub(r"<[^>]*>", "", text).split(" ")).replace("\n", " ")


def values_of(text: str, unit: Unit, pattern: str) -> Iterator[tuple[float, float]]:
    """Yield the ends of the values that round to each number that a text states."""
    for groups in re.findall(pattern, text):
        number, symbol = [group for group in groups if group] + [""] * (2 - sum(map(bool, groups)))
        value = number.rstrip(".,")
        decimals = len(value.partition(".")[2])
        factor = unit.factor(symbol) if symbol else 1.0
        assert factor is not None
        half = 0.5000001 * 10.0**-decimals
        yield (float(value) - half) * factor, (float(value) + half) * factor


@pytest.mark.parametrize("name", list(SCENES)[: amount(4, len(SCENES))])
def test_what_all_panes_state_of_a_quantity_is_one_value(
    application: Application, user: User, name: str
) -> None:
    store = application.scene_store
    store.put(store.scene.replace(**SCENES[name]), "scene")
    texts = list(dict.fromkeys(texts_of(application, user)))
    found: dict[str, list[tuple[float, float]]] = defaultdict(list)
    ways: dict[str, int] = {}
    for quantity, (unit, patterns) in STATEMENTS.items():
        for pattern in patterns:
            values = [value for text in texts for value in values_of(text, unit, pattern)]
            ways[quantity] = ways.get(quantity, 0) + bool(values)
            found[quantity] += values
    for quantity, values in found.items():
        lows, highs = [low for low, _ in values], [high for _, high in values]
        assert max(lows, default=0.0) <= min(highs, default=0.0), (quantity, values)
    has_code = store.scene.transmitter.light == "code"
    stated_twice = {quantity for quantity, count in ways.items() if count > 1}
    has_edges = bool(store.scene.transmitter.edge_time)  # the light of the story then has them
    expected = {"level in the column"} | (set() if has_edges else {"lit time"})
    assert not has_code or stated_twice >= expected, ways
    if has_code:
        assert stated_twice >= {"exposure over period", "band model's end", "first null"}
    elif name != "no bars":
        assert "depth of the bars" in stated_twice
    check_band_model(application, texts)
    check_bars(application, texts)
    check_times(application)


def check_band_model(application: Application, texts: list[str]) -> None:
    """Check that all places have the band model, or none."""
    results = application.results_store.results
    is_undefined = bool(results.reading.band_undefined)
    places = (
        any("no band model here" in text for text in texts),  # the legend
        any(text.startswith("The band model is undefined here") for text in texts),
    )
    if application.scene_store.scene.transmitter.light == "code":
        assert set(places) == {is_undefined}


def check_bars(application: Application, texts: list[str]) -> None:
    """Check that the story and the pane of bars agree on whether there are bars."""
    if application.scene_store.scene.transmitter.light != "code":
        has_none = application.story.verdict.heading.endswith(": no bars")
        assert has_none == any(text.startswith("No bars at ") for text in texts)


def check_times(application: Application) -> None:
    """Check that the last picture's time is among those that the pane of accuracy states."""
    snapshot = application.results_store.results.snapshot
    times = application.simulation.moves.costs_of(snapshot.frame).picture.times
    stated = application.window.findChildren(StatusLine)[0].timing.toolTip()
    ((low, high),) = values_of(stated, SECOND, rf"simulated in {_T}")
    assert high >= times.least
    assert low <= times.most
    line = application.view("accuracy").answer.line.text()
    assert f"the picture in {times}" in line
