"""What each framing sends, and what it says when it reads nothing."""

import binascii

import numpy as np
import pytest

import occ_model as occ
from occ_model.arrays import ByteArray, IndexArray
from occ_model.transmitter import registry
from occ_model.transmitter.framings.c_ook import read_sub_packet
from occ_model.transmitter.framings.framing import BARKER, own_preamble
from occ_model.transmitter.scheme import scheme_named

LINE_CODES = registry.LINE_CODES.built_in()


def chips_of(text: str) -> ByteArray:
    return np.array([int(chip) for chip in text.replace(" ", "")], dtype=np.uint8)


def text_of(chips: ByteArray | IndexArray) -> str:
    return "".join(map(str, chips.tolist()))


@pytest.mark.parametrize(
    ("code", "preamble"),
    [("manchester", "011100"), ("4b6b", "0011111000"), ("differential-manchester", "011100")],
)
def test_the_preambles_of_c_ook_are_those_of_the_standard(code: str, preamble: str) -> None:
    assert text_of(own_preamble(LINE_CODES[code])) == preamble


@pytest.mark.parametrize("code", [name for name in LINE_CODES if name != "nrz"])
def test_no_payload_contains_the_preamble_of_its_code(code: str) -> None:
    preamble = own_preamble(LINE_CODES[code])
    random = np.random.default_rng(1)
    for bits in (*range(8, 200, 8), 4096):
        data = LINE_CODES[code].encode(random.integers(0, 2, bits).astype(np.uint8), 0)
        endless = text_of(np.tile(np.concatenate([preamble, data]), 2))
        assert endless.count(text_of(preamble)) == 2


@pytest.mark.parametrize("code", ["differential-manchester", "manchester", "4b6b", "fsk"])
def test_a_run_of_ones_stands_between_as_many_zeros(code: str) -> None:
    preamble = own_preamble(LINE_CODES[code])
    assert 2 * int(preamble.sum()) == len(preamble)


def test_the_preamble_of_8b10b_is_the_comma_k28_5() -> None:
    assert text_of(own_preamble(LINE_CODES["8b10b"])) == "1100000101"


def test_barker_correlates_with_no_shift_of_itself() -> None:
    signs = 2.0 * np.array(BARKER) - 1.0
    correlation = np.correlate(signs, signs, mode="full")
    peak = len(BARKER) - 1
    assert correlation[peak] == 13.0
    assert np.abs(np.delete(correlation, peak)).max() == 1.0


def test_c_ook_sends_a_short_payload_as_one_sub_packet() -> None:
    one = scheme_named("manchester", "c-ook", "", "none", 4)
    # The preamble, the asynchronous bit 0, the payload 1011, the asynchronous bit once more.
    assert text_of(one.encode([1, 0, 1, 1])) == "011100" + "01" + "10011010" + "01"


def test_c_ook_sends_a_long_payload_as_numbered_sub_packets() -> None:
    one = scheme_named("manchester", "c-ook", "", "none", 40)
    sent = text_of(one.encode(np.zeros(40, dtype=int)))
    assert sent.count("011100") == 3
    assert len(sent) == 3 * (6 + 2 * (14 + 2 * 2))


def test_c_ook_reads_of_its_last_sub_packet_what_the_payload_fills() -> None:
    payload = np.array([1, 0, 1, 1, 0] * 8)
    one = scheme_named("manchester", "c-ook", "", "none", 40)
    sent = one.encode(payload).reshape(3, -1)
    parts = [read_sub_packet(chips, one.form) for chips in sent]
    assert [number for number, _, _ in parts] == [0, 1, 2]
    assert [problem for _, _, problem in parts] == [None] * 3
    assert [len(bits) for _, bits, _ in parts] == [14, 14, 12]
    np.testing.assert_array_equal(np.concatenate([bits for _, bits, _ in parts]), payload)


def test_c_ook_joins_a_sub_packet_that_the_picture_cuts() -> None:
    one = scheme_named("manchester", "c-ook", "", "none", 10)
    sent = one.encode([1, 0, 1, 1, 0, 0, 1, 1, 1, 0])
    cut = np.roll(sent, 11)  # the preamble in the middle, data before it and after it
    assert one.decode(cut).bits.tolist() == [1, 0, 1, 1, 0, 0, 1, 1, 1, 0]
    wrong = cut.copy()
    wrong[9:11] ^= 1  # the asynchronous bit at the end
    assert one.decode(wrong).failure == (
        "The asynchronous bits at a sub-packet's start and end differ."
    )


def test_c_ook_names_the_sub_packets_that_are_missing() -> None:
    one = scheme_named("manchester", "c-ook", "", "none", 40)
    sent = one.encode(np.arange(40) % 2)
    read = one.decode(sent[: one.length // 3 + 4])
    assert read.failure.startswith("1 of 3 sub-packets were read; the first missing is number 2.")


@pytest.mark.parametrize("bits", [1, 127, 128, 4096])
def test_raw_carries_length_payload_and_crc_16(bits: int) -> None:
    payload = np.random.default_rng(bits).integers(0, 2, bits)
    one = scheme_named("nrz", "raw", "01", "none", bits)
    sent = one.encode(payload)
    head = f"{bits:08b}" if bits < 128 else f"1{bits:015b}"
    body = head + text_of(payload)
    octets = np.packbits(chips_of(body)).tobytes()
    assert text_of(sent) == f"01{body}{binascii.crc_hqx(octets, 0xFFFF):016b}"


def test_raw_needs_not_know_how_many_bits_are_sent() -> None:
    payload = [1, 0, 0, 1, 1, 0, 1]
    sent = scheme_named("manchester", "raw", "", "none", 7).encode(payload)
    other = scheme_named("manchester", "raw", "", "none", 5)
    assert other.decode(np.tile(sent, 3)).bits.tolist() == payload


def test_raw_finds_every_pair_of_wrong_chips() -> None:
    one = scheme_named("nrz", "raw", "", "none", 8)
    sent = one.encode([1, 1, 0, 0, 1, 0, 1, 0])
    first = len(BARKER) + 8  # behind the number of bits
    for one_place in range(first, len(sent)):
        for other in range(one_place + 1, len(sent)):
            wrong = sent.copy()
            wrong[[one_place, other]] ^= 1
            assert one.decode(np.concatenate([wrong, wrong])).failure is not None


def test_a_given_preamble_starts_the_frame() -> None:
    scene = occ.Scene().replace(framing="preamble", preamble="1100 0011".replace(" ", ""), code=1)
    assert text_of(occ.packet(scene)[:8]) == "11000011"


def test_a_preamble_inside_the_payload_is_told_not_guessed() -> None:
    one = scheme_named("nrz", "preamble", "10", "none", 6)
    read = one.decode(np.tile(one.encode([1, 0, 1, 1, 0, 0]), 3))
    assert "The payload contains the preamble" in read.failure
    assert not read.bits.size


def test_padding_that_is_not_0_is_found() -> None:
    one = scheme_named("4b6b", "preamble", "", "none", 3)
    sent = one.encode([1, 0, 1])  # and a zero: the word of 10
    other = scheme_named("4b6b", "preamble", "", "none", 4).encode([1, 0, 1, 1])
    assert one.decode(np.tile(sent, 3)).bits.tolist() == [1, 0, 1]
    assert one.decode(np.tile(other, 3)).failure == (
        "The bits that fill the last block are not 0: some chips were misread."
    )


def test_the_first_and_last_chip_may_be_cut_off() -> None:
    one = scheme_named("manchester", "preamble", "", "none", 10)
    payload = [1, 0, 1, 1, 0, 0, 1, 1, 1, 0]
    sent = one.encode(payload)
    # The preamble stands in the middle, so that the frame is joined of both ends.
    seen = np.resize(np.roll(sent, one.length // 2), one.length + 2)
    seen[[0, -1]] ^= 1
    read = one.decode(seen)
    assert (read.failure, read.bits.tolist()) == (None, payload)


def test_the_papers_framing_tells_too_few_chips_from_chips_without_headers() -> None:
    one = scheme_named("manchester", "paper", "", "none", 10)
    few, many = (np.tile(chips_of("10"), number) for number in (12, 60))
    assert "24 of 48 chips fit the panel's image" in (one.decode(few).failure or "")
    assert "No header found among 120 chips" in (one.decode(many).failure or "")


@pytest.mark.parametrize("framing", ["preamble", "raw"])
def test_too_few_chips_are_counted_in_the_failure(framing: str) -> None:
    one = scheme_named("manchester", framing, "", "none", 10)
    read = one.decode(one.encode(np.zeros(10, dtype=int))[:9])
    assert f"9 of {one.length} chips fit" in read.failure
