"""Time: where a column's exposure starts and ends among the chips."""

from hard_cases.laws import cases, record
from hypothesis import strategies as st


@cases(x=st.floats(0, 1))
def test_smoke(x: float) -> None:
    record("smoke", "0 to 1", x * 0)
