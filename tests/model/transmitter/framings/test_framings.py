"""What each framing sends, and its failure when it reads nothing."""

import binascii

import numpy as np
import pytest
from each_case import each_case

import occ_model as occ
from occ_model.arrays import ByteArray, IndexArray
from occ_model.transmitter import registry
from occ_model.transmitter.framings.c_ook import read_sub_packet
from occ_model.transmitter.framings.framing import BARKER, own_preamble
from occ_model.transmitter.framings.raw import check_sum
from occ_model.transmitter.scheme import scheme_named

LINE_CODES = registry.LINE_CODES.load_built_in()


def chips_of(text: str) -> ByteArray:
    return np.array([int(chip) for chip in text.replace(" ", "")], dtype=np.uint8)


def text_of(chips: ByteArray | IndexArray) -> str:
    return "".join(map(str, chips.tolist()))


@pytest.mark.parametrize(
    ("code", "preamble"),
    [
        ("manchester", "011100"),
        ("4b6b", "0011111000"),
        ("differential-manchester", "011100"),
        ("8b10b", "1100000101"),
    ],  # the comma K28.5
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


def test_barker_correlates_with_no_shift_of_itself() -> None:
    signs = 2.0 * np.array(BARKER) - 1.0
    correlation = np.correlate(signs, signs, mode="full")
    peak = len(BARKER) - 1
    assert correlation[peak] == 13.0
    assert np.abs(np.delete(correlation, peak)).max() == 1.0


def test_c_ook_sends_a_short_payload_as_one_sub_packet() -> None:
    one = scheme_named("manchester", "c-ook", "", "none", 4)
    # The preamble, the asynchronous bit 0, the payload 1011, the asynchronous bit again.
    assert text_of(one.encode([1, 0, 1, 1])) == "011100" + "01" + "10011010" + "01"


def test_c_ook_sends_a_long_payload_as_numbered_sub_packets() -> None:
    one = scheme_named("manchester", "c-ook", "", "none", 40)
    sent = text_of(one.encode(np.zeros(40, dtype=int)))
    assert sent.count("011100") == 3
    assert len(sent) == 3 * (6 + 2 * (14 + 2 * 2))


def test_c_ook_reads_only_the_payload_in_its_last_sub_packet() -> None:
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
    cut = np.roll(sent, 11)  # the preamble in the middle, with data before and after it
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


RAW_PAYLOAD = "1011001110001111010100101101110010100110"

# CRC16-IBM-3740 of the first 1 to 40 bits with their number, by calc_bits of anycrc 2.1.0.
CHECK_SUMS = np.frombuffer(
    bytes.fromhex(
        "e3a216e9bcfb07612aa08c0c8990031e707fa593d2aebd247caeff29e5caa4c637cd0adabc15a022"
        "d6a39b900c7acc1a755cb5abfeb4bf1d4974316dbfe206f2594639a76142df02a6917e9acfc54aa8"
    ),
    dtype=">u2",
)


def test_raw_carries_length_payload_and_the_crc_16_of_the_bits_sent() -> None:
    for bits, expected in enumerate(CHECK_SUMS.tolist(), start=1):
        payload = RAW_PAYLOAD[:bits]
        sent = scheme_named("nrz", "raw", "01", "none", bits).encode(chips_of(payload))
        assert text_of(sent) == f"01{bits:08b}{payload}{expected:016b}"


@pytest.mark.parametrize("bits", [120, 128, 4096])
def test_the_crc_16_of_whole_bytes_is_that_of_the_bytes(bits: int) -> None:
    """Recordings of such payloads from before can therefore still be read."""
    payload = np.random.default_rng(bits).integers(0, 2, bits)
    sent = scheme_named("nrz", "raw", "01", "none", bits).encode(payload)
    body = (f"{bits:08b}" if bits < 128 else f"1{bits:015b}") + text_of(payload)
    octets = np.packbits(chips_of(body)).tobytes()
    assert text_of(sent) == f"01{body}{binascii.crc_hqx(octets, 0xFFFF):016b}"


@each_case(range(1, 41))
def test_raw_finds_every_pair_of_wrong_bits_and_every_burst_of_up_to_16(bits: int) -> None:
    """The check sum is linear over GF(2): an error passes only if its own check sum is 0."""
    body = np.concatenate([chips_of(f"{bits:08b}"), np.zeros(bits, dtype=np.uint8)])
    zero = check_sum(body)
    of_bits = []
    for place in range(8, len(body)):
        one = body.copy()
        one[place] = 1
        of_bits.append(int(text_of(check_sum(one) ^ zero), 2))
    of_bits += [1 << place for place in reversed(range(16))]
    assert len(set(of_bits)) == len(of_bits)  # or two wrong bits would cancel
    for first in range(len(of_bits)):
        sums = np.zeros(1, dtype=np.int64)
        for of_bit in of_bits[first : first + 16]:
            sums = np.concatenate([sums, sums ^ of_bit])
        assert np.count_nonzero(sums == 0) == 1  # no error at all


def test_a_check_sum_is_linear() -> None:
    random = np.random.default_rng(7)
    for bits in (9, 18, 40, 200):
        one, other, third = random.integers(0, 2, (3, bits)).astype(np.uint8)
        together = check_sum(one) ^ check_sum(other) ^ check_sum(third)
        np.testing.assert_array_equal(check_sum(one ^ other ^ third), together)


def test_raw_needs_not_know_how_many_bits_are_sent() -> None:
    payload = [1, 0, 0, 1, 1, 0, 1]
    sent = scheme_named("manchester", "raw", "", "none", 7).encode(payload)
    other = scheme_named("manchester", "raw", "", "none", 5)
    assert other.decode(np.tile(sent, 3)).bits.tolist() == payload


def test_a_given_preamble_starts_the_frame() -> None:
    scene = occ.Scene().replace(framing="preamble", preamble="1100 0011".replace(" ", ""), code=1)
    assert text_of(occ.packet(scene)[:8]) == "11000011"


def test_a_preamble_inside_the_payload_is_a_failure_and_no_guess() -> None:
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
        "The bits that fill the last block are not 0: some chips were misread, or another number "
        "of bits is sent."
    )


def test_the_first_and_last_chip_may_be_cut_off() -> None:
    one = scheme_named("manchester", "preamble", "", "none", 10)
    payload = [1, 0, 1, 1, 0, 0, 1, 1, 1, 0]
    sent = one.encode(payload)
    # The preamble is in the middle, so that the frame is joined from both ends.
    seen = np.resize(np.roll(sent, one.length // 2), one.length + 2)
    seen[[0, -1]] ^= 1
    read = one.decode(seen)
    assert (read.failure, read.bits.tolist()) == (None, payload)


def test_the_papers_framing_says_how_many_headers_it_found_among_how_many_chips() -> None:
    one = scheme_named("manchester", "paper", "", "none", 10)
    chips = np.tile(chips_of("10"), 60)
    assert one.decode(chips).failure == "No header found among 120 chips, two needed."
    # The stripes do show a run as long as a header's.
    one_header = np.concatenate([chips, chips_of("1110"), chips])
    assert one.decode(one_header).failure == "One header found among 244 chips, two needed."


def test_packets_of_another_length_are_not_called_misread_chips_alone() -> None:
    """Every chip is right, of 8 bits where 10 are awaited."""
    sent = scheme_named("differential-manchester", "paper", "", "none", 8)
    chips = np.tile(sent.encode([1, 0, 1, 1, 0, 0, 1, 0]), 3)
    failure = scheme_named("differential-manchester", "paper", "", "none", 10).decode(chips).failure
    assert failure == (
        "The first two headers are 20 chips apart, a packet of 10 bits has 24: some chips were "
        "misread, or packets of another length are sent."
    )


@pytest.mark.parametrize("framing", ["preamble", "raw"])
def test_too_few_chips_are_counted_in_the_failure(framing: str) -> None:
    one = scheme_named("manchester", framing, "", "none", 10)
    read = one.decode(one.encode(np.zeros(10, dtype=int))[:9])
    assert read.failure == f"Less than one packet: 9 chips of its {one.length}."
