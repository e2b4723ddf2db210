"""Values that a scene may hold, for hypothesis, and the presets of codes."""

from hypothesis import strategies as st

from occ_model.scene.canonical_text import CanonicalText
from occ_model.scene.light_samples import canonical_samples
from occ_model.scene.parameter_kinds import ChipPattern, Choice, Count, Parameter, Payload, Quantity
from occ_model.scene.presets import load_preset, presets

_LETTERS = st.characters(exclude_categories=["Cs"])

PAYLOADS: st.SearchStrategy[str] = st.one_of(
    st.just(""),
    st.text(_LETTERS, min_size=1, max_size=12).map("text:{}".format),
    st.binary(min_size=1, max_size=24).map(lambda octets: f"hex:{octets.hex()}"),
    st.text("01", min_size=1, max_size=40).map("bits:{}".format),
)
"""Texts, bytes and bits in their shortest form, and nothing."""

_FRACTIONS = st.floats(0.0, 1.0)

LEVEL_LINES: st.SearchStrategy[str] = st.lists(_FRACTIONS.map(repr), min_size=1, max_size=12).map(
    " ".join
)

_ROWS = st.lists(st.tuples(st.floats(1e-6, 1.0), _FRACTIONS), min_size=2, max_size=12)


def _rows_text(rows: list[tuple[float, float]]) -> str:
    seconds = [sum(length for length, _ in rows[:number]) for number in range(len(rows))]
    return canonical_samples(
        "\n".join(f"{at!r},{level!r}" for at, (_, level) in zip(seconds, rows, strict=True))
    )


def _matrix_text(numbers: list[int]) -> str:
    rows = (numbers[first : first + 3] for first in (0, 3, 6))
    # A large diagonal can be inverted.
    return " / ".join(
        " ".join(f"{(number + 10 * (row == column)) / 16:g}" for column, number in enumerate(line))
        for row, line in enumerate(rows)
    )


CANONICAL_TEXTS = {
    "mixing": st.one_of(
        st.just(""), st.lists(st.integers(0, 4), min_size=9, max_size=9).map(_matrix_text)
    ),
    "levels": LEVEL_LINES,
    "waveform_file": st.one_of(st.just(""), _ROWS.map(_rows_text)),
}


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
        case CanonicalText():
            return CANONICAL_TEXTS[parameter.name]


def presets_of_codes() -> tuple[str, ...]:
    """Return the names of the presets whose transmitter sends one code."""
    scenes = {name: load_preset(name) for name in presets()}
    return tuple(
        name
        for name, scene in scenes.items()
        if scene.transmitter.light == "code" and scene.colours.bayer == "none"
    )
