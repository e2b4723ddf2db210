"""Any value can be quoted in a sentence."""

import pytest

from occ_model.errors import _LONGEST_VALUE, one_line, shown


def nested(levels: int) -> object:
    value: object = []
    for _ in range(levels):
        value = [value]
    return value


@pytest.mark.parametrize(
    "value",
    [10**5000, -(10**5000), "x" * 10**6, nested(5000), {"a": nested(5000)}, b"\0" * 10**5],
    ids=["large", "small", "text", "nested", "table", "bytes"],
)
def test_a_value_is_quoted_in_few_characters(value: object) -> None:
    assert 0 < len(shown(value)) <= 100


def test_of_a_long_value_begin_and_end_are_quoted() -> None:
    quoted = shown([f"{letter * 50}" for letter in "abcd"])
    assert len(quoted) <= _LONGEST_VALUE + 3
    begin, end = quoted.split("...", 1)[0], quoted.rsplit("...", 1)[1]
    assert begin.startswith("['aaa")
    assert end.endswith("ddd']")


@pytest.mark.parametrize("value", [718, 1.5, "10 kHz", None, True, [1, 2], {"a": 1}])
def test_a_short_value_is_quoted_as_repr_does(value: object) -> None:
    assert shown(value) == repr(value)


@pytest.mark.parametrize("length", [1, 30, _LONGEST_VALUE - 3, _LONGEST_VALUE - 2])
def test_a_text_of_just_the_length_allowed_is_not_cut(length: int) -> None:
    assert shown("x" * length) == repr("x" * length)


def test_an_object_that_cannot_be_written_is_quoted_all_the_same() -> None:
    class Broken:
        def __repr__(self) -> str:
            raise RuntimeError

    assert "Broken" in shown(Broken())


def test_control_characters_are_shown_escaped() -> None:
    assert one_line("a\nb\x1b[31mc\u202ed\udc80") == "a\\nb\\x1b[31mc\\u202ed\\udc80"
    assert one_line("Stra\xdfe 5 \u03bcs") == "Stra\xdfe 5 \u03bcs"


def test_a_long_name_is_cut() -> None:
    assert len(one_line("n" * 10**7)) == 200


def test_a_name_of_just_the_length_allowed_is_not_cut() -> None:
    assert one_line("n" * 200) == "n" * 200
    assert one_line("n" * 201) == "n" * 199 + "…"
