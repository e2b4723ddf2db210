"""Sequence detection: bit error rates at known timing, optimality, and correct likelihoods."""

import itertools

import numpy as np
import pytest
from amount import amount
from physics.exposed_chips import expose_rows, manchester, noise_of

import occ_model as occ
from occ_model.receiver.sequence.exposures import RowTiming, gather, taps
from occ_model.receiver.sequence.fit import lit_fractions
from occ_model.receiver.sequence.search import Chips, find_all_best_chips, least_distances
from occ_model.receiver.sequence.trellis import FREE_CHIPS, Word, make_trellis
from occ_model.scene.scene import Scene

MANCHESTER = (Word(0, (0, 1), 0), Word(0, (1, 0), 0))
STEP, PHASE = 0.2, 0.13  # five rows a chip, none of them at a chip's edge

POINTS = [(7, 15, 3e-2), (7, 20, 8e-4), (7, 30, 1e-4), (4, 10, 6e-2), (4, 20, 1e-4)]
"""Exposure in chips, signal-to-noise ratio in decibels, and the required bit error rate."""


def detect(light: np.ndarray, exposure: float, words: tuple[Word, ...] = MANCHESTER) -> Chips:
    timing = RowTiming(exposure, STEP, PHASE)
    return find_all_best_chips(make_trellis(words, timing.memory), [gather(light, timing)])[0]


def detect_bits(
    exposure: float, decibels: float, bits: int, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return which bits are wrong, and the margins of all."""
    random = np.random.default_rng(seed)
    sent = manchester(random.integers(0, 2, bits))
    light = expose_rows(sent, exposure, STEP, PHASE)
    found = detect(light + noise_of(decibels) * random.standard_normal(len(light)), exposure)
    place = found.first + np.arange(len(found.values))
    second = (place >= 0) & (place < len(sent)) & (place % 2 == 1)
    wrong = found.values[second] != sent[place[second]]
    return wrong, found.margins[second]


@pytest.mark.parametrize(("exposure", "decibels", "most"), POINTS)
def test_bit_errors_of_manchester_stay_below_the_rates(
    exposure: float, decibels: float, most: float
) -> None:
    sent = amount(10_000, 20_000)
    wrong, _ = detect_bits(exposure, decibels, sent, seed=1)
    assert wrong.size >= sent - 10
    assert wrong.mean() <= most


def test_the_lit_fraction_of_a_row_is_that_of_the_chips_under_its_exposure() -> None:
    values = np.array([1, 0, 0, 1, 1, 0], dtype=np.uint8)
    chips = Chips(0, values, np.ones(6))
    timing = RowTiming(1.5, 0.25, 0.0)
    model, slope = lit_fractions(chips, timing, 18)
    # Exact, by a running integral of the light.
    lit = np.concatenate([[0.0], np.cumsum(values)])
    starts = 0.25 * np.arange(18)
    ends = np.interp(np.add.outer([1.5, 1.501], starts), np.arange(7), lit)
    begins = np.interp(np.add.outer([0.0, 0.001], starts), np.arange(7), lit)
    fractions = (ends - begins) / 1.5
    np.testing.assert_allclose(model, fractions[0], atol=1e-12)
    np.testing.assert_allclose(slope, (fractions[1] - fractions[0]) / 0.001, atol=1e-9)


@pytest.mark.parametrize("words", [MANCHESTER, FREE_CHIPS], ids=["Manchester", "free"])
@pytest.mark.parametrize("exposure", [0.4, 1.0, 2.7])
def test_no_other_sequence_is_nearer_to_the_rows(words: tuple[Word, ...], exposure: float) -> None:
    random = np.random.default_rng(7)
    count = 10
    sent = manchester(random.integers(0, 2, count // 2))
    light = expose_rows(sent, exposure, STEP, 0.0)
    light = light + 0.2 * random.standard_normal(len(light))
    timing = RowTiming(exposure, STEP, 0.0)
    statistics = gather(light, timing)
    trellis = make_trellis(words, timing.memory)
    (least,) = least_distances(trellis, [statistics])
    (chips,) = find_all_best_chips(trellis, [statistics])
    every = np.array(list(itertools.product([0, 1], repeat=count)))
    if words is MANCHESTER:
        # Both alignments of the pairs, each also with another chip at the end.
        pairs = np.array([manchester(np.array(b)) for b in itertools.product([0, 1], repeat=6)])
        every = np.concatenate([pairs[:, :count], pairs[:, 1 : count + 1]])
    distances = [
        float(((expose_rows(one, exposure, STEP, 0.0) - light) ** 2).sum()) for one in every
    ]
    assert least == pytest.approx(min(distances), abs=1e-9)
    best = every[int(np.argmin(distances))]
    np.testing.assert_array_equal(chips.values[-chips.first :][:count], best)


def test_a_margin_is_what_the_opposite_chip_costs() -> None:
    random = np.random.default_rng(5)
    exposure, count = 1.6, 9
    sent = random.integers(0, 2, count)
    light = expose_rows(sent, exposure, STEP, 0.0)
    light = light + 0.15 * random.standard_normal(len(light))
    timing = RowTiming(exposure, STEP, 0.0)
    (found,) = find_all_best_chips(make_trellis(FREE_CHIPS, timing.memory), [gather(light, timing)])
    every = np.array(list(itertools.product([0, 1], repeat=count)))
    distances = np.array(
        [((expose_rows(one, exposure, STEP, 0.0) - light) ** 2).sum() for one in every]
    )
    for chip in range(count - 1):
        lit = every[:, chip] == 1
        cost = abs(distances[lit].min() - distances[~lit].min())
        assert found.margins[chip - found.first] == pytest.approx(cost, abs=1e-9)


@pytest.mark.parametrize(
    ("exposure", "start", "fractions"),
    [
        (1.0, 0.25, [0.75, 0.25]),
        (1.5, 0.0, [2 / 3, 1 / 3]),
        (1.5, 0.75, [1 / 6, 2 / 3, 1 / 6]),
        (2.5, 0.5, [0.2, 0.4, 0.4]),
    ],
)
def test_taps_are_the_overlaps_of_exposure_and_chips(
    exposure: float, start: float, fractions: list[float]
) -> None:
    last, found = taps(RowTiming(exposure, 0.1), np.array([start]))
    in_time = found[::-1, 0][-int(last[0]) - 1 :]
    np.testing.assert_allclose(in_time[: len(fractions)], fractions, atol=1e-12)
    assert found.sum() == pytest.approx(1.0)


def test_stated_likelihoods_are_those_of_the_errors() -> None:
    # Near the limit of readability, about a fraction p of the bits with the stated probability p
    # must be right.
    wrong, margins = detect_bits(7.0, 14.0, 20_000, seed=4)
    ratio = margins / (2.0 * noise_of(14.0) ** 2)
    stated = 1.0 / (1.0 + np.exp(ratio))
    for low, high in ((0.0, 0.02), (0.02, 0.1), (0.1, 0.3), (0.3, 0.5)):
        some = (stated >= low) & (stated < high)
        assert wrong[some].mean() == pytest.approx(stated[some].mean(), rel=0.35, abs=0.002)


@pytest.mark.parametrize(
    ("averaging", "enhancement"),
    [
        ("pixel-value", "none"),
        ("light", "stretch"),
        ("pixel-value", "equalization"),
        *(
            pytest.param(*both, marks=pytest.mark.whole)
            for both in (("light", "none"), ("pixel-value", "stretch"), ("light", "equalization"))
        ),
    ],
)
@pytest.mark.parametrize("frequency", [4e3, 14.7e3, 40e3])
def test_codes_are_read_on_both_sides_of_the_null(
    frequency: float, averaging: str, enhancement: str
) -> None:
    random = np.random.default_rng(int(frequency))
    for code in random.integers(0, 1024, amount(1, 3)).tolist():
        scene = occ.load_preset("phone-136us").replace(
            rows=60, switching_frequency=frequency, code=code, averaging=averaging,
            enhancement=enhancement, start_time=float(random.uniform(0.0, 1e-2)),
        )  # fmt: skip
        result = occ.decode(occ.render(scene).signal, scene, "sequence")
        assert result.code == code
        assert result.bit_likelihoods.min() > 0.99


def test_a_signal_that_no_chips_explain_is_refused() -> None:
    random = np.random.default_rng(3)
    noise = random.normal(100.0, 5.0, 3456)
    smooth = np.convolve(random.normal(100.0, 20.0, 3472), np.ones(17) / 17.0, "valid")
    for signal in (noise, smooth, np.resize(np.repeat([0.0, 255.0], 9), 3456)):
        for frequency in amount((40e3,), (5e3, 10e3, 20e3, 40e3)):
            scene = Scene().replace(switching_frequency=frequency, enhancement="none")
            result = occ.decode(signal, scene, "sequence")
            assert result.code is None
            assert result.failure is not None


def test_codes_given_in_heavy_noise_are_right() -> None:
    random = np.random.default_rng(8)
    given, right = 0, 0
    for _ in range(amount(12, 40)):
        code, noise = int(random.integers(1024)), float(random.uniform(5.0, 80.0))
        scene = occ.load_preset("phone-136us").replace(
            switching_frequency=25e3, code=code, enhancement="none",
            start_time=float(random.uniform(0.0, 1e-3)),
        )  # fmt: skip
        signal = occ.column_profile(scene) + noise * random.standard_normal(3456)
        read = occ.decode(signal, scene, "sequence").code
        given += read is not None
        right += read == code
    assert amount(3, 10) <= given < amount(12, 40)
    assert right == given


@pytest.mark.parametrize("wrong", [-0.01, 0.005, 0.01])
@pytest.mark.parametrize("frequency", [10e3, 30e3])
def test_a_readout_time_up_to_1_percent_off_is_followed(wrong: float, frequency: float) -> None:
    random = np.random.default_rng(int(frequency))
    code = int(random.integers(1024))
    scene = occ.load_preset("phone-136us").replace(
        switching_frequency=frequency, code=code, enhancement="none",
        start_time=float(random.uniform(0.0, 1e-3)),
    )  # fmt: skip
    signal = occ.column_profile(scene)[860:2590] + random.standard_normal(1730)
    off = scene.replace(readout_time=scene.camera.readout_time * (1.0 + wrong))
    result = occ.decode(signal, off, "sequence")
    assert result.code == code
    true = scene.transmitter.switching_period / scene.camera.readout_time
    assert result.chip_length == pytest.approx(true, rel=1e-4)


def test_a_readout_time_far_off_gives_no_code() -> None:
    scene = occ.load_preset("phone-136us").replace(
        rows=60, switching_frequency=20e3, enhancement="none"
    )
    signal = occ.render(scene).signal
    off = scene.replace(readout_time=scene.camera.readout_time * 1.05)
    result = occ.decode(signal, off, "sequence")
    assert result.code is None
    assert "do not explain the signal" in (result.failure or "")
