"""Header and bits are where the decoder read them, and the threshold divides the columns."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.results.decoding import DecodeResult
from occ_model.results.frame import Frame
from occ_model.teaching.light_over_columns import light_over_columns
from occ_model.teaching.packet_fields import (
    packet_fields,
    received_edges,
    received_fields,
    threshold_levels,
)
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.line_codes import differential_manchester
from occ_model.transmitter.scheme import scheme_of


def read(**changes: float) -> tuple[Frame, DecodeResult]:
    scene = occ.load_preset("phone-68us").replace(rows=300, **changes)
    frame = occ.render(scene, tolerance=np.inf)
    return frame, occ.decode(frame.image, scene)


@pytest.mark.parametrize("exposure", [68e-6, 136e-6])
def test_the_fields_received_hold_header_and_bits(exposure: float) -> None:
    frame, result = read(exposure_time=exposure)
    fields = received_fields(result, frame.scene)
    header, *bits = fields
    assert header.bit is None
    assert tuple(result.chips[header.first : header.last]) == HEADER
    assert [field.bit for field in bits] == list(range(10))
    chips = np.concatenate([result.chips[field.first : field.last] for field in bits])
    decoded, violations = differential_manchester.decode(chips, level=HEADER[-1])
    assert not violations
    np.testing.assert_array_equal(decoded, result.bits)


def test_the_fields_sent_cover_the_packet_once() -> None:
    scene = occ.load_preset("phone-68us")
    fields = packet_fields(scene)
    chips = [chip for field in fields for chip in range(field.first, field.last)]
    assert chips == list(range(len(occ.packet(scene))))
    assert packet_fields(scene.replace(pattern="0100101")) == ()


@pytest.mark.parametrize("framing", ["paper", "preamble"])
@pytest.mark.parametrize("line_code", ["differential-manchester", "manchester", "nrz"])
def test_the_fields_of_a_text_hold_its_bits_one_after_the_other(
    line_code: str, framing: str
) -> None:
    scene = occ.Scene().replace(payload="HELLO", line_code=line_code, framing=framing)
    header, *bits = packet_fields(scene)
    chips = occ.packet(scene)
    assert [field.bit for field in bits] == list(range(40))
    assert (header.first, header.last, bits[-1].last) == (0, bits[0].first, len(chips))
    scheme = scheme_of(scene.transmitter)
    level = int(chips[header.last - 1])
    decoded = scheme.line_code.decode(chips[header.last :], level)
    assert tuple(decoded.bits.tolist()) == scene.transmitter.payload_bits


@pytest.mark.parametrize(
    "changes",
    [
        {"line_code": "4b6b"},
        {"line_code": "fsk"},
        {"framing": "raw"},
        {"framing": "c-ook"},
        {"error_correction": "reed-solomon"},
    ],
)
def test_bits_without_chips_of_their_own_have_no_fields(changes: dict[str, str]) -> None:
    assert packet_fields(occ.Scene().replace(payload="HELLO", **changes)) == ()


def test_a_result_without_chips_has_no_places() -> None:
    frame, _ = read()
    result = occ.decode(frame.image, frame.scene, decoder="matched")
    assert received_fields(result, frame.scene) == ()
    assert received_edges(result) is None


@pytest.mark.parametrize("exposure", [20e-6, 68e-6, 136e-6])
@pytest.mark.parametrize(
    ("decoder", "fraction"), [("threshold", 0.5), ("equalizer", 0.5), ("sequence", 0.0)]
)
def test_a_received_chip_is_where_it_was_sent(
    exposure: float, decoder: str, fraction: float
) -> None:
    """Or half an exposure earlier, where the chip is in the middle of a column's exposure."""
    frame, _ = read(exposure_time=exposure)
    result = occ.decode(frame.image, frame.scene, decoder=decoder)
    edges = received_edges(result)
    assert len(edges) == len(result.chips) + 1
    late = fraction * exposure / frame.scene.camera.readout_time
    curve = light_over_columns(frame.scene, -50.0, len(frame.profile) + 2 * late, 10_000)
    middles = (edges[1:-2] + edges[2:-1]) / 2 + late
    sent = curve.levels[np.searchsorted(curve.edges, middles) - 1]
    np.testing.assert_array_equal(sent, result.chips[1:-1])


def test_a_threshold_for_light_is_not_one_for_the_profile() -> None:
    frame, _ = read(exposure_time=136e-6)
    result = occ.decode(frame.image, frame.scene, decoder="equalizer")
    assert result.threshold is not None
    assert threshold_levels(frame.profile, result) is None


def test_the_threshold_divides_the_profile_as_the_decoder_does() -> None:
    frame, result = read()
    levels = threshold_levels(frame.profile, result)
    part = frame.profile[result.region.first_column : result.region.last_column]
    assert levels[0] < levels[1]
    middle = sum(levels) / 2
    np.testing.assert_array_equal(part > middle, result.signal > result.threshold)
    low, high = threshold_levels(frame.signal, result) or (0.0, 0.0)
    assert low <= result.threshold <= high


def test_columns_beside_the_panel_do_not_hide_the_threshold() -> None:
    frame, result = read()
    profile = frame.profile.copy()
    first = result.region.first_column
    lit = first + np.flatnonzero(result.signal > result.threshold)
    profile[lit[:5]] = 0.0
    assert threshold_levels(profile, result) == threshold_levels(frame.profile, result)
    rng = np.random.default_rng(3)
    assert threshold_levels(rng.normal(size=len(profile)), result) is None


def test_lights_that_are_no_code_have_no_packet() -> None:
    for light in ("lamp", "mains", "waveform", "pulses"):
        assert packet_fields(occ.Scene().replace(light=light)) == ()
