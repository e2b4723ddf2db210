"""Sentences on values that are not grey levels, and on chips shorter than a column."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.receiver.decoder import has_short_chips


@pytest.mark.parametrize("far", [1e9, -1e9])
def test_a_value_that_is_not_a_grey_level_is_refused_and_stated(far: float) -> None:
    image = np.full((4, 30), 100.0)
    image[2, 7] = far
    with pytest.raises(occ.DecodeInputError, match=r"has values from .*\b1e\+09.*; allowed"):
        occ.decode(image, occ.Scene())


REASON = "A chip of 2 µs is shorter than the 8 µs from one column to the next: "


@pytest.mark.parametrize("decoder", ["threshold", "matched", "equalizer", "sequence"])
def test_a_failure_states_that_chips_are_shorter_than_a_column(decoder: str) -> None:
    scene = occ.load_preset("phone-136us").replace(switching_frequency=500e3)
    result = occ.decode(occ.column_profile(scene), scene, decoder)
    assert result.failure.startswith(REASON)
    assert len(result.failure.split(". ")) > 1  # the decoder's own reason follows


def test_a_chip_as_long_as_a_column_is_not_too_short() -> None:
    scene = occ.load_preset("phone-136us").replace(readout_time=2.0**-17)
    assert not has_short_chips(scene.replace(switching_frequency=2.0**17))
    assert has_short_chips(scene.replace(switching_frequency=1.01 * 2.0**17))


@pytest.mark.parametrize("kilohertz", [130, 300, 375, 400, 500, 610, 750, 1000])
def test_the_matched_decoder_reads_no_wrong_code_from_columns_that_skip_chips(
    kilohertz: int,
) -> None:
    # At round ratios the columns of all packets show the same few places of a packet.
    scene = occ.load_preset("phone-136us").replace(switching_frequency=1e3 * kilohertz)
    random = np.random.default_rng(kilohertz)
    for code in random.integers(0, 1024, 6).tolist():
        sent = scene.replace(code=code)
        signal = occ.column_profile(sent) + random.normal(0.0, 0.5, scene.camera.columns)
        result = occ.decode(signal, sent, "matched")
        assert result.code in {code, None}
        if kilohertz == 130:  # chips are short, but the packets together show each of them
            assert result.code == code


def test_a_payload_read_from_short_chips_is_not_a_failure() -> None:
    """The threshold decoder does not know the length of a chip and may read longer ones."""
    slow = occ.load_preset("phone-68us").replace(switching_frequency=6e3, distance=0.6)
    scene = slow.replace(switching_frequency=150e3, readout_time=10e-6)
    read = occ.decode(occ.column_profile(slow), scene, "threshold")
    assert (read.code, read.failure) == (slow.transmitter.code, None)
    failure = occ.decode(occ.column_profile(scene), scene, "threshold").failure
    assert "shorter than" in failure
    assert failure.endswith("some chips were misread, or packets of another length are sent.")


def test_two_codes_that_look_the_same_are_stated_before_short_chips() -> None:
    """At 130 kHz a chip is short as well, but the code is read, so this need not be the cause."""
    scene = occ.load_preset("phone-68us").replace(switching_frequency=150e3)
    noise = np.random.default_rng(2).normal(0.0, 30.0, scene.camera.columns)
    result = occ.decode(occ.column_profile(scene) + noise, scene, "matched")
    assert not result.failure.startswith("A chip of")
    assert result.failure.endswith("not every chip has a column of its own.")
