"""Which results of a plug-in's decoder are refused."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.receiver.plugin_result import problem_of
from occ_model.results.decoding import RunHistogram, Runs


@pytest.mark.parametrize(
    ("lengths", "is_refused"), [([3, 4], False), ([0, 4], False), ([3, -1], True), ([-1, 3], True)]
)
def test_no_run_and_no_count_of_runs_is_negative(lengths: list[int], is_refused: bool) -> None:
    values = np.array(lengths)
    runs = Runs(np.array([1, 0], np.uint8), values)
    histogram = RunHistogram(values, None)
    for changes in ({"runs": runs}, {"histograms": (histogram, histogram)}):
        result = occ.DecodeResult("own", failure="Nothing was read.", **changes)
        assert (problem_of(result, columns=10) is not None) is is_refused


def with_headers(headers: object) -> str | None:
    chips, bits = np.array([1, 0, 0]), np.array([1])
    result = occ.DecodeResult("own", code=1, bits=bits, chips=chips, headers=headers)  # type: ignore[arg-type]
    return problem_of(result, columns=10)


@pytest.mark.parametrize("headers", [(), (0,), (2,), (0, 1, 2), (np.int64(1),)])
def test_headers_are_places_among_the_chips(headers: tuple[int, ...]) -> None:
    assert with_headers(headers) is None


@pytest.mark.parametrize(
    "headers", [(-1,), (3,), (0, 3), (-1, 0), (1.0,), (0, "1"), (True,), [0], None]
)
def test_headers_elsewhere_are_refused(headers: object) -> None:
    said = with_headers(headers)
    assert said is not None
    assert said.endswith("which are not places among its chips")


@pytest.mark.parametrize(
    ("code", "bits", "failure", "is_refused"),
    [
        (1, [1], None, False),
        (None, [1], None, True),
        (1, [], None, True),
        (None, [], None, True),
        (None, [], "Nothing was read.", False),
        (-1, [1], None, True),
        (0, [0], None, False),
    ],
)
def test_a_result_has_a_code_with_its_bits_or_says_why_not(
    code: int | None, bits: list[int], failure: str | None, is_refused: bool
) -> None:
    result = occ.DecodeResult("own", code=code, bits=np.array(bits, np.uint8), failure=failure)
    assert (problem_of(result, columns=10) is not None) is is_refused


@pytest.mark.parametrize(
    ("name", "value", "is_refused"),
    [
        ("threshold", -5.0, False), ("threshold", 1e6, False), ("threshold", float("nan"), True),
        ("chip_length", 0.0, False), ("chip_length", -0.1, True), ("chip_length", 1e6, False),
        ("correlation", -1.0, False), ("correlation", -1.1, True), ("correlation", 1.1, True),
        ("confidence", 0.0, False), ("confidence", -0.1, True), ("confidence", 1.1, True),
        ("confidence", "sure", True), ("confidence", None, False),
    ],
)  # fmt: skip
def test_each_number_has_its_range(name: str, value: object, is_refused: bool) -> None:
    result = occ.DecodeResult("own", failure="Nothing was read.", **{name: value})  # type: ignore[arg-type]
    assert (problem_of(result, columns=10) is not None) is is_refused


@pytest.mark.parametrize("bad", [0, 1])
def test_each_histogram_is_looked_at(bad: int) -> None:
    good = RunHistogram(np.array([3, 4]), None)
    pair = [good, good]
    result = occ.DecodeResult("own", failure="Nothing was read.", histograms=(good, good))
    assert problem_of(result, columns=10) is None
    pair[bad] = RunHistogram(np.array([3.5, 4.0]), None)
    result = occ.DecodeResult("own", failure="Nothing was read.", histograms=(pair[0], pair[1]))
    assert problem_of(result, columns=10) is not None
