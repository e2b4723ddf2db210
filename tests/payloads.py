"""Payloads that a scene may hold, for hypothesis."""

from hypothesis import strategies as st

_LETTERS = st.characters(exclude_categories=["Cs"])

PAYLOADS: st.SearchStrategy[str] = st.one_of(
    st.just(""),
    st.text(_LETTERS, min_size=1, max_size=12).map("text:{}".format),
    st.binary(min_size=1, max_size=24).map(lambda octets: f"hex:{octets.hex()}"),
    st.text("01", min_size=1, max_size=40).map("bits:{}".format),
)
"""Texts, bytes and bits in their shortest form, and nothing."""
