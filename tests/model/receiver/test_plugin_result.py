"""Which results of a plug-in's decoder are refused."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.receiver.plugin_result import problem_of


def with_headers(headers: object) -> str | None:
    chips, bits = np.array([1, 0, 0]), np.array([1])
    result = occ.DecodeResult("own", code=1, bits=bits, chips=chips, headers=headers)  # type: ignore[arg-type]
    return problem_of(result, columns=10)


@pytest.mark.parametrize("headers", [(), (0,), (2,), (0, 1, 2)])
def test_headers_are_places_among_the_chips(headers: tuple[int, ...]) -> None:
    assert with_headers(headers) is None


@pytest.mark.parametrize("headers", [(-1,), (3,), (0, 3), (-1, 0), (1.0,), (0, "1"), [0]])
def test_headers_elsewhere_are_refused(headers: object) -> None:
    said = with_headers(headers)
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
