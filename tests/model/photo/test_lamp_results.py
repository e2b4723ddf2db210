"""A lamp is told in its own words in every result, and other lights are refused."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from matches import match_of_lamp, match_with
from simulated_photos import photo_of

import occ_model as occ
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.many.table import table_of
from occ_model.photo.match_facts import format_facts, match_facts
from occ_model.results.match import NEVER_CHANGES, PLAIN_STRIPES, Alternative, known_value
from occ_model.results.photo_table import PhotoRow, csv_text

BASE = occ.load_preset("phone-68us").replace(rows=40, columns=500, exposure_time=3e-4)


def bars() -> occ.Photo:
    return photo_of(np.tile(np.repeat([30, 210], 20).astype(np.uint8), (80, 20)))


@pytest.mark.parametrize("light", ["mains", "waveform"])
def test_a_light_that_is_no_lamp_is_refused_unless_chips_are_read(light: str) -> None:
    scene = BASE.replace(light=light)
    with pytest.raises(occ.ParameterError, match="code, lamp or pulses; or let what is sent"):
        occ.match_photo(bars(), scene)
    with pytest.raises(occ.MatchError) as refused:
        occ.match_photo(bars(), scene, sent="read")
    assert refused.value.reasons[0] == PLAIN_STRIPES


@pytest.mark.parametrize(
    ("changes", "sent"),
    [({"duty": 1.0}, "scene"), ({"duty": 0.0}, "scene"), ({"depth": 0.0}, "auto")],
)
def test_a_lamp_that_never_changes_makes_no_stripes(changes: dict[str, float], sent: str) -> None:
    scene = BASE.replace(light="lamp", lamp_frequency=1e3)
    with pytest.raises(occ.MatchError) as refused:
        occ.match_photo(bars(), scene.replace(**changes), sent=sent)
    assert refused.value.reasons == (NEVER_CHANGES,)


@pytest.mark.parametrize("sent", ["auto", "read"])
def test_flashes_and_one_pulse_of_chips_are_lamps(sent: str) -> None:
    flashes = BASE.replace(light="pulses", pulse_frequency=1e3, pulse_length=5e-4)
    chips = BASE.replace(pattern="1000", switching_frequency=4e3)
    match = occ.match_photo(bars(), flashes, sent=sent)
    assert (match.scene.transmitter.light, match.lamp_frequency) == ("lamp", 1e3)
    assert match.readout_time == pytest.approx(1.0 / (1e3 * 40.0), rel=2e-3)
    if sent == "auto":
        assert occ.match_photo(bars(), chips).readout_time == match.readout_time
        return
    with pytest.raises(occ.MatchError) as refused:
        occ.match_photo(bars(), chips, sent=sent)
    assert refused.value.reasons[0] == PLAIN_STRIPES


DUTY, CYCLES, READOUT = 0.3, 850.0, 11e-6


@pytest.fixture(scope="module")
def photo() -> occ.Photo:
    scene = BASE.replace(
        rows=80, columns=1200, light="lamp", lamp_frequency=CYCLES, duty=DUTY, readout_time=READOUT,
        exposure_time=1e-4, averaging="light", enhancement="none", panel_width=3.0,
    )  # fmt: skip
    return photo_of(occ.render(scene, tolerance=0.0, seed=2).image)


@pytest.mark.parametrize("estimate", ["readout_time", "switching_frequency"])
def test_a_lamp_is_measured_and_told_in_its_own_words(photo: occ.Photo, estimate: str) -> None:
    known = BASE.replace(light="lamp", lamp_frequency=CYCLES, duty=DUTY, readout_time=READOUT)
    match = occ.match_photo(photo, known, sent="scene", estimate=estimate)
    assert (match.scene.transmitter.light, match.duty) == ("lamp", DUTY)
    name, truth = {
        "readout_time": ("readout_time", READOUT), "switching_frequency": ("lamp_frequency", CYCLES)
    }[estimate]  # fmt: skip
    assert match.estimate == name
    assert {match.known, name} == {"readout_time", "lamp_frequency"}
    assert abs(getattr(match, name) - truth) < 4.0 * match.uncertainties[name]
    assert match.scene.value(name) == getattr(match, name)
    cycles = match.exposure_time * (match.lamp_frequency or 0.0)
    assert match.exposure_in_periods == pytest.approx(cycles)
    again = occ.match_photo(photo, match.scene, sent="scene", estimate=estimate)
    assert again.is_applied_to(match.scene)
    assert not again.is_applied_to(match.scene.replace(bayer="rggb"))
    said = "\n".join(format_facts(match_facts(match, "if it is a lamp of 850 Hz: ")))
    assert "chip" not in said
    assert "duty cycle            30 %" in said


def test_a_scene_states_what_blinks_as_a_lamp_whichever_way_it_is_given() -> None:
    chips = BASE.replace(pattern="1000", switching_frequency=4e3)
    lamp = BASE.replace(light="lamp", lamp_frequency=1e3)
    flashes = BASE.replace(light="pulses", pulse_frequency=1e3)
    for scene in (chips, lamp, flashes):
        assert known_value("readout_time", scene) == ("lamp_frequency", 1e3)
        readout = known_value("switching_frequency", scene)
        assert readout == ("readout_time", scene.camera.readout_time)
    code = BASE.replace(switching_frequency=7e3)
    assert known_value("readout_time", code) == ("switching_frequency", 7e3)


def test_another_lamp_among_the_alternatives_is_told_by_its_own_frequency() -> None:
    lamp = Alternative("a lamp", "1100", 0.9, -9.0, 1e-5, 4e3, 1e-4)
    code = Alternative("a code", "11010", 0.9, -9.0, 1e-5, 4e3, 1e-4)
    assert (lamp.lamp_frequency, code.lamp_frequency) == (1e3, None)
    errors = {"lamp_frequency": 1.0, "exposure_time": 1e-7}
    match = match_of_lamp(uncertainties=errors, alternatives=(lamp, code))
    said = [fact.text for fact in match_facts(match) if fact.key == "alternative"]
    assert ["lamp frequency 1 kHz" in said[0], "switching frequency 4 kHz" in said[1]] == [True] * 2


@pytest.mark.parametrize("estimate", ["readout_time", "switching_frequency"])
def test_a_table_of_lamps_states_their_frequencies_and_duties(estimate: str) -> None:
    name = "lamp_frequency" if estimate == "switching_frequency" else estimate
    errors = {name: 1e-3 * (1e3 if name == "lamp_frequency" else 14.5777e-6)}
    matches = [match_of_lamp(0.3, uncertainties={**errors, "exposure_time": 1e-7})] * 2
    rows = [PhotoRow(Path(f"{n}.png"), "sure", match=one) for n, one in enumerate(matches)]
    scene = occ.Scene().replace(light="lamp", lamp_frequency=1e3)
    table = table_of(MatchSettings(scene, estimate), rows)
    assert (table.estimate, table.known) == (
        name, "lamp_frequency" if name == "readout_time" else "readout_time",
    )  # fmt: skip
    assert table.estimated is not None
    assert table.estimated.value == pytest.approx(getattr(matches[0], name))
    lines = [line for line in csv_text(table).splitlines() if line[0] != "#"]
    heads, first, _ = csv.reader(lines)
    assert heads[16:] == ["note", "lamp frequency (Hz)", "its error (Hz)", "duty", "its error"]
    assert heads[5] == "switching frequency (Hz)"
    assert (first[5], first[13]) == ("", ""), "a lamp has no chips"
    assert (float(first[17]), float(first[19])) == (1e3, 0.3)
    assert (first[18] == "") == (name == "readout_time")


def test_a_mean_over_codes_and_lamps_is_that_of_the_codes() -> None:
    errors = {"switching_frequency": 2.0, "exposure_time": 1e-7}
    code = match_with(uncertainties=errors)
    lamp = match_of_lamp(uncertainties={"lamp_frequency": 1.0, "exposure_time": 1e-7})
    rows = [PhotoRow(Path("x.png"), "sure", match=one) for one in (code, lamp)]
    table = table_of(MatchSettings(occ.Scene(), "switching_frequency"), rows)
    assert table.estimate == "switching_frequency"
    assert table.estimated is not None
    assert (table.estimated.count, table.estimated.value) == (1, 2e3)
    assert math.isclose(table.estimated.uncertainty, 2.0)
