"""The laws of every line code, and the properties that each declares."""

from collections.abc import Iterator
from itertools import product

import numpy as np
import pytest
from amount import amount
from each_case import each_case

from occ_model.arrays import ByteArray
from occ_model.scene.payload import MAX_PAYLOAD_BITS
from occ_model.transmitter.line_codes.line_code import VISIBLE_LIMIT, LineCode
from occ_model.transmitter.registry import LINE_CODES as REGISTRY
from occ_model.transmitter.scheme import bits_of

LINE_CODES = REGISTRY.load_built_in()

every_code = each_case(LINE_CODES.values())


def all_payloads(most: int) -> Iterator[ByteArray]:
    """List every payload of up to a number of bits."""
    for bits in range(1, most + 1):
        for number in range(2**bits):
            yield np.array(bits_of(number, bits), dtype=np.uint8)


def some_payloads() -> Iterator[ByteArray]:
    """Draw random payloads of all lengths, one of the greatest length among them."""
    random = np.random.default_rng(20)
    for bits in (*range(9, 60), 100, 333, 1000, MAX_PAYLOAD_BITS):
        yield random.integers(0, 2, bits).astype(np.uint8)
    yield np.zeros(MAX_PAYLOAD_BITS, dtype=np.uint8)
    yield np.ones(MAX_PAYLOAD_BITS, dtype=np.uint8)
    # D11.7 before D12.0 at a running disparity of +1: one of the few runs of five in 8B10B.
    yield np.unpackbits(np.array([3, 235, 12], dtype=np.uint8))


def longest_run(chips: ByteArray) -> int:
    edges = np.flatnonzero(np.diff(chips)) + 1
    return int(np.diff(np.concatenate([[0], edges, [len(chips)]])).max())


def disparity(chips: ByteArray) -> int:
    return abs(2 * int(chips.sum()) - len(chips))


def check_round_trip(code: LineCode, bits: ByteArray, level: int) -> None:
    chips = code.encode(bits, level)
    assert chips.dtype == np.uint8
    assert len(chips) == code.chips_for(len(bits))
    read = code.decode(chips, level)
    assert read.failure is None
    assert read.violations == ()
    np.testing.assert_array_equal(read.bits[: len(bits)], bits)
    assert not read.bits[len(bits) :].any()
    assert len(read.bits) - len(bits) < code.block_bits


@each_case(product(LINE_CODES.values(), (0, 1)))
def test_short_payloads_are_read_as_they_were_sent(code: LineCode, level: int) -> None:
    for bits in all_payloads(7):
        check_round_trip(code, bits, level)


@every_code
def test_long_payloads_are_read_as_they_were_sent(code: LineCode) -> None:
    for bits in some_payloads():
        check_round_trip(code, bits, 0)


@every_code
def test_every_block_is_read_after_every_other(code: LineCode) -> None:
    # A block depends on itself, and on the level or disparity that those before it leave.
    width = code.block_bits
    blocks = np.array([bits_of(number, width) for number in range(2**width)], dtype=np.uint8)
    for block in blocks[:: amount(max(1, len(blocks) // 16), 1)]:
        check_round_trip(
            code, np.stack([np.broadcast_to(block, blocks.shape), blocks], 1).ravel(), 0
        )


@every_code
def test_runs_reach_the_longest_declared_and_no_further(code: LineCode) -> None:
    runs = [longest_run(code.encode(bits, 0)) for bits in some_payloads()]
    if code.longest_run is None:
        assert max(runs) == MAX_PAYLOAD_BITS
    else:
        assert max(runs) == code.longest_run


@every_code
def test_ones_and_zeros_differ_by_the_disparity_declared(code: LineCode) -> None:
    differences = [disparity(code.encode(bits, 0)) for bits in some_payloads()]
    expected = MAX_PAYLOAD_BITS if code.disparity is None else code.disparity
    assert max(differences) == expected


@every_code
def test_whole_blocks_have_the_chips_a_bit_declared(code: LineCode) -> None:
    bits = 12 * code.block_bits
    chips = len(code.encode(np.ones(bits, dtype=np.uint8), 0))
    assert chips == code.chips_a_bit * bits
    assert 1 - bits / chips == pytest.approx(float(code.overhead))


@every_code
def test_a_wrong_chip_is_found_or_harmless_if_it_is_declared(code: LineCode) -> None:
    escaped = 0
    for bits in (*all_payloads(4), *list(some_payloads())[:20]):
        chips = code.encode(bits, 0)
        for place in range(len(chips)):
            wrong = chips.copy()
            wrong[place] ^= 1
            read = code.decode(wrong, 0)
            found = read.failure is not None or read.bits[len(bits) :].any()
            escaped += not found and not np.array_equal(read.bits[: len(bits)], bits)
    assert (escaped == 0) is code.finds_wrong_chip


@pytest.mark.parametrize(
    "code", [code for code in LINE_CODES.values() if code.block_chips > 1], ids=lambda c: c.name
)
def test_a_partial_block_of_chips_is_refused(code: LineCode) -> None:
    read = code.decode(np.zeros(code.block_chips + 1, dtype=np.uint8), 0)
    assert read.failure == (
        f"{code.block_chips + 1} chips are not a whole number of blocks of "
        f"{code.block_chips} chips."
    )
    assert not read.bits.size


@every_code
def test_from_the_least_frequency_no_run_lasts_long_enough_to_be_seen(code: LineCode) -> None:
    least = code.least_switching_frequency
    if code.longest_run is None:
        assert least is None
    else:
        assert code.longest_run / least == pytest.approx(0.5 / VISIBLE_LIMIT)
