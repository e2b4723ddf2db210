"""Line code, framing and error correction together, in every combination."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from amount import amount
from documents import FOLDER, text_of
from each_case import each_case

import occ_model as occ
from occ_model.arrays import ByteArray, IndexArray
from occ_model.scene.parameters import open_choice
from occ_model.transmitter import registry
from occ_model.transmitter.error_correction import PARITY_BYTES, count_protected_bits
from occ_model.transmitter.framings.c_ook import FRAMING as C_OOK
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.registry import Registry
from occ_model.transmitter.scheme import Scheme, scheme_named, sends_paper_code

LINE_CODES = registry.LINE_CODES.load_built_in()
FRAMINGS = registry.FRAMINGS.load_built_in()

CORRECTIONS = ("none", "reed-solomon")

PAIRS = [
    (code, framing)
    for code, framing in itertools.product(LINE_CODES, FRAMINGS)
    if (code, framing) != ("nrz", C_OOK.name)
]
"""Every line code in every framing, except the one pair that is refused."""

AMBIGUOUS = [(code, "paper") for code in ("nrz", "4b6b", "8b10b", "fsk")]
"""Schemes whose payloads may contain the header, so that its place can be ambiguous."""

every_pair = each_case(PAIRS)


def scheme(code: str, framing: str, bits: int, correction: str = "none") -> Scheme:
    return scheme_named(code, framing, "", correction, bits)


def repeat_chips(chips: ByteArray, start: int, count: int) -> ByteArray:
    """Repeat a period of chips, starting at any of them."""
    return np.resize(np.roll(chips, -start), count)


def fits_another_payload(one: Scheme, payload: IndexArray) -> bool:
    """Return whether another payload gives the same endless chips."""
    chips = one.encode(payload)
    turns = [np.roll(chips, -start) for start in range(1, one.length)]
    return any(
        one.line_code.decode(turned[len(HEADER) :], HEADER[-1]).failure is None
        for turned in turns
        if tuple(turned[: len(HEADER)]) == HEADER
    )


@pytest.mark.parametrize("correction", CORRECTIONS)
@pytest.mark.parametrize(("code", "framing"), PAIRS)
def test_two_periods_from_any_start_give_the_payload(
    code: str, framing: str, correction: str
) -> None:
    for bits in amount((1, 7, 17, 300), (1, 2, 7, 10, 16, 17, 40, 300)):
        one = scheme(code, framing, bits, correction)
        random = np.random.default_rng(bits)
        for _ in range(4):
            payload = random.integers(0, 2, bits)
            chips = one.encode(payload)
            assert len(chips) == one.length
            start = int(random.integers(0, one.length))
            read = one.decode(repeat_chips(chips, start, 2 * one.length + 8))
            if read.failure is not None:
                assert (code, framing) in AMBIGUOUS
                assert fits_another_payload(one, payload)
            else:
                np.testing.assert_array_equal(read.bits, payload)


@every_pair
def test_a_payload_of_4096_bits_comes_back(code: str, framing: str) -> None:
    one = scheme(code, framing, 4096)
    payload = np.random.default_rng(5).integers(0, 2, 4096)
    read = one.decode(repeat_chips(one.encode(payload), 77, 2 * one.length + 8))
    if (code, framing) in (("nrz", "paper"), ("nrz", "preamble")):
        assert "The payload contains the preamble" in read.failure
    else:
        assert read.failure is None
        np.testing.assert_array_equal(read.bits, payload)


@every_pair
def test_no_part_of_what_is_sent_gives_another_payload(code: str, framing: str) -> None:
    random = np.random.default_rng(3)
    for bits in (5, 16, 24):
        one = scheme(code, framing, bits)
        payload = random.integers(0, 2, bits)
        chips = one.encode(payload)
        for _ in range(amount(15, 40)):
            count = int(random.integers(1, 3 * one.length))
            start = int(random.integers(0, one.length))
            read = one.decode(repeat_chips(chips, start, count))
            if read.failure is None:
                np.testing.assert_array_equal(read.bits, payload)


@every_pair
def test_a_wrong_chip_is_found_or_harmless_if_it_is_promised(code: str, framing: str) -> None:
    one = scheme(code, framing, 10)
    if not one.finds_wrong_chip:
        return
    random = np.random.default_rng(8)
    for _ in range(amount(1, 3)):
        payload = random.integers(0, 2, 10)
        chips = repeat_chips(
            one.encode(payload), int(random.integers(one.length)), 2 * one.length + 8
        )
        for place in range(len(chips)):
            wrong = chips.copy()
            wrong[place] ^= 1
            read = one.decode(wrong)
            assert read.failure is not None or read.bits.tolist() == payload.tolist()


@every_pair
def test_two_wrong_bytes_are_corrected(code: str, framing: str) -> None:
    bits = 64
    one = scheme(code, framing, bits, "reed-solomon")
    payload = np.random.default_rng(2).integers(0, 2, bits)
    form_bits = count_protected_bits(bits)
    assert form_bits == bits + 8 * PARITY_BYTES
    if framing in ("c-ook", "raw") or (code, framing) in AMBIGUOUS:
        return
    line_code = LINE_CODES[code]
    chips = one.encode(payload)
    start = one.length - line_code.chips_for(form_bits)
    period = chips.copy()
    period[start + 2 : start + 4] ^= 1  # in the first byte of every repetition
    read = one.decode(repeat_chips(period, 0, 2 * one.length + 8))
    assert read.failure is None
    np.testing.assert_array_equal(read.bits, payload)


def test_too_many_wrong_bytes_to_correct_are_a_failure() -> None:
    one = scheme("nrz", "preamble", 64, "reed-solomon")
    chips = one.encode(np.zeros(64))
    chips[-64:] ^= np.resize(np.array([1, 0, 0, 1, 0, 0, 0, 1], dtype=np.uint8), 64)
    read = one.decode(repeat_chips(chips, 0, 2 * one.length))
    assert "More than 2 bytes of a block are wrong" in read.failure


@pytest.mark.parametrize("wrong_sum", [0, 1])
def test_two_wrong_bytes_are_corrected_before_the_check_sum_is_compared(wrong_sum: int) -> None:
    one = scheme("nrz", "raw", 64, "reed-solomon")
    payload = np.random.default_rng(2).integers(0, 2, 64)
    chips = one.encode(payload)
    chips[-16 - 8 * 12 :][[0, 30]] ^= 1
    chips[-1] ^= wrong_sum
    read = one.decode(repeat_chips(chips, 0, 2 * one.length))
    assert (read.failure is not None) == wrong_sum
    np.testing.assert_array_equal(read.bits, payload)


def passing_share(octets: int) -> float:
    """Return the share of blocks with three wrong bytes that are corrected to another payload.

    Such an error is two bytes away from a codeword of weight 5. A maximum distance separable code
    of distance 5 has 255 C(n, 5) of these codewords, and each is near 10 of the 255^3 C(n, 3)
    errors.
    """
    return math.comb(octets + PARITY_BYTES - 3, 2) / 255**2


@pytest.mark.parametrize("octets", [20, 100, 251])
def test_three_wrong_bytes_pass_as_often_as_stated_and_never_behind_a_check_sum(
    octets: int,
) -> None:
    tries = amount(60, 1000)
    random = np.random.default_rng(6)
    accepted = dict.fromkeys(("preamble", "raw"), 0)
    for framing, check_chips in (("preamble", 0), ("raw", 16)):
        one = scheme("manchester", framing, 8 * octets, "reed-solomon")
        first = one.length - 2 * (8 * (octets + PARITY_BYTES) + check_chips)
        for _ in range(tries):
            chips = one.encode(random.integers(0, 2, 8 * octets))
            for place in random.choice(octets + PARITY_BYTES, 3, replace=False):
                wrong = np.unpackbits(np.array([random.integers(1, 256)], dtype=np.uint8))
                chips[first + 16 * place :][:16] ^= np.repeat(wrong, 2)
            accepted[framing] += one.decode(repeat_chips(chips, 0, 2 * one.length)).failure is None
    share = passing_share(octets)
    off = 4 * math.sqrt(tries * share * (1 - share))
    assert accepted["preamble"] == pytest.approx(tries * share, abs=off)
    assert accepted["raw"] == 0
    said = f"{100 * share:.2g} % at {octets}"
    assert said in text_of(FOLDER / "decoding.md").replace("\n", " ")


def test_the_default_is_the_papers_packet() -> None:
    scene = occ.Scene()
    assert occ.scheme_of(scene.transmitter).is_papers
    assert sends_paper_code(scene.transmitter)
    text = "1110" + "10" + "100110" + "0110" + "011010" + "10"
    assert len(text) == occ.scheme_of(scene.transmitter).length
    assert occ.packet(scene)[:4].tolist() == [1, 1, 1, 0]
    assert not sends_paper_code(scene.replace(line_code="manchester").transmitter)
    assert not sends_paper_code(scene.replace(payload="bits:01").transmitter)


@pytest.mark.parametrize("registry", [registry.LINE_CODES, registry.FRAMINGS])
def test_the_names_of_codes_and_framings_are_those_that_the_scene_declares(
    registry: Registry[Any],
) -> None:
    choices = open_choice(registry.parameter).choices
    assert tuple(each.name for each in registry.load_built_in().values()) == choices
