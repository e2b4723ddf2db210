"""Values that a scene may hold, for hypothesis."""

from hypothesis import strategies as st

from occ_model.scene.parameter_kinds import ChipPattern, Choice, Count, Parameter, Payload, Quantity

_LETTERS = st.characters(exclude_categories=["Cs"])

PAYLOADS: st.SearchStrategy[str] = st.one_of(
    st.just(""),
    st.text(_LETTERS, min_size=1, max_size=12).map("text:{}".format),
    st.binary(min_size=1, max_size=24).map(lambda octets: f"hex:{octets.hex()}"),
    st.text("01", min_size=1, max_size=40).map("bits:{}".format),
)
"""Texts, bytes and bits in their shortest form, and nothing."""


def values_of(parameter: Parameter) -> st.SearchStrategy[float | int | str]:
    """Any value that a parameter accepts."""
    match parameter:
        case Quantity():
            return st.floats(parameter.low, parameter.high)
        case Count():
            return st.integers(parameter.low, parameter.high)
        case Choice():
            return st.sampled_from(parameter.choices)
        case ChipPattern():
            return st.text("01", max_size=40)
        case Payload():
            return PAYLOADS
