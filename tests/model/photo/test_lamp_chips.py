"""A lamp is fitted as chips of one pulse, and is a lamp again in every result."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from matches import match_of_lamp, match_with
from simulated_photos import photo_of

import occ_model as occ
from occ_model.photo.lamp_chips import in_chips, with_lamp
from occ_model.photo.many.row import MatchSettings
from occ_model.photo.many.table import table_of
from occ_model.photo.match_facts import format_facts, match_facts
from occ_model.results.match import Alternative, Match, known_value
from occ_model.results.photo_table import PhotoRow, csv_text

BASE = occ.load_preset("phone-68us").replace(rows=40, columns=500, exposure_time=3e-4)
BLURRED = {"edge_time": 2e-5, "point_spread": 1.0}


def chips_as_lamp(pattern: str, frequency: float, **more: float) -> tuple[occ.Scene, Match]:
    """Return a scene of chips, and a match with it whose chips are made a lamp."""
    scene = BASE.replace(pattern=pattern, switching_frequency=len(pattern) * frequency, **more)
    errors = {"switching_frequency": 5.0, "start_time": 1e-6}
    found = match_with(
        scene=scene, pattern=pattern, switching_frequency=scene.transmitter.switching_frequency,
        start_time=scene.model.start_time, uncertainties=errors,
    )  # fmt: skip
    return scene, with_lamp(found, BASE)


@pytest.mark.parametrize("pattern", ["10", "01", "1110000000", "0011111110", "1" * 49 + "0"])
@pytest.mark.parametrize("more", [{"start_time": 1.234e-3}, BLURRED], ids=["sharp", "blurred"])
def test_the_lamps_picture_is_that_of_its_chips(pattern: str, more: dict[str, float]) -> None:
    chips, match = chips_as_lamp(pattern, 239.0, **more)
    lamp = match.scene
    assert (lamp.transmitter.light, match.lamp_frequency) == ("lamp", 239.0)
    assert match.duty == pattern.count("1") / len(pattern)
    assert match.start_time == lamp.model.start_time
    assert match.uncertainties["lamp_frequency"] == 5.0 / len(pattern)
    picture, of_lamp = (occ.render(each, tolerance=0.0, seed=3).image for each in (chips, lamp))
    np.testing.assert_array_equal(of_lamp, picture)
    profile, profile_of_lamp = (occ.column_profile(each) for each in (chips, lamp))
    # The duty of most pulses is no binary fraction.
    most = 0.0 if pattern == "10" else 1e-11
    np.testing.assert_allclose(profile_of_lamp, profile, rtol=0.0, atol=most)


def test_a_lamp_keeps_the_code_that_its_scene_would_send() -> None:
    given = BASE.replace(code=345, switching_frequency=6e3)
    pulse = given.replace(pattern="1100", switching_frequency=4e3)
    found = match_with(scene=pulse, pattern="1100", switching_frequency=4e3)
    scene = with_lamp(found, given).scene
    assert scene.replace(light="code", start_time=0.0).transmitter == given.transmitter.replaced(
        {"lamp_frequency": 1e3}
    )
    code = match_with(scene=given.replace(pattern="11010"), pattern="11010")
    assert with_lamp(code, given) is code
    assert (code.lamp, code.lamp_frequency, code.duty) == (None, None, None)


@pytest.mark.parametrize(
    ("duty", "parts"),
    [(0.5, "10"), (0.3, "1110000000"), (0.94, "1" * 47 + "000"), (0.004, "1" + "0" * 249),
     (0.0, "0"), (1.0, "1"), (1e-9, "1" + "0" * 999)],
)  # fmt: skip
def test_a_lamp_is_a_pulse_of_few_chips(duty: float, parts: str) -> None:
    sent = in_chips(BASE.replace(light="lamp", lamp_frequency=1e3, duty=duty), is_read=False)
    assert sent.transmitter.pattern == parts
    assert sent.transmitter.switching_frequency == 1e3 * len(parts)
    flashes = BASE.replace(light="pulses", pulse_frequency=1e3, pulse_length=1e-3 * max(duty, 1e-6))
    if duty > 1e-6:
        assert in_chips(flashes, is_read=False).transmitter.pattern == parts


def test_a_light_that_is_no_lamp_is_refused_unless_it_is_read() -> None:
    photo = photo_of(np.tile(np.repeat([30, 210], 20).astype(np.uint8), (80, 20)))
    for light in ("mains", "waveform"):
        scene = BASE.replace(light=light)
        with pytest.raises(occ.ParameterError, match="code, lamp or pulses; or let what is sent"):
            occ.match_photo(photo, scene)
        assert occ.match_photo(photo, scene, sent="read").duty == 0.5
    with pytest.raises(occ.ParameterError, match=r"Lamp frequency is 0\.1 Hz; allowed where"):
        occ.match_photo(photo, BASE.replace(light="lamp", lamp_frequency=0.1))


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
    assert match.exposure_in_periods == pytest.approx(
        match.exposure_time * not_zero(match.lamp_frequency)
    )
    again = occ.match_photo(photo, match.scene, sent="scene", estimate=estimate)
    assert again.is_applied_to(match.scene)
    said = "\n".join(format_facts(match_facts(match, "if it is a lamp of 850 Hz: ")))
    assert "chip" not in said
    assert "duty cycle            30 %" in said


def not_zero(value: float | None) -> float:
    assert value
    return value


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
