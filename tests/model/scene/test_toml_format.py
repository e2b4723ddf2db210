"""Scene files: TOML written and read."""

import pytest
from each_case import each_case
from hypothesis import given, strategies as st
from scene_values import values_of

from occ_model.errors import SceneFileError
from occ_model.scene.parameter_kinds import Count
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.parameters.light import MAX_BITS
from occ_model.scene.scene import GROUPS, Scene
from occ_model.scene.toml_format import parse_toml


@st.composite
def scenes(draw: st.DrawFn) -> Scene:
    """Draw any possible scene."""
    changes = {name: draw(values_of(parameter)) for name, parameter in PARAMETERS.items()}
    declared = PARAMETERS["bits"]
    assert isinstance(declared, Count)
    fewest = max(declared.low, int(changes["code"]).bit_length())
    changes["bits"] = draw(st.integers(fewest, MAX_BITS))
    return Scene().replace(**changes)


def exact_texts(scene: Scene) -> list[str]:
    """Write all values exactly, with the sign of a zero."""
    texts = []
    for name in PARAMETERS:
        value = scene.value(name)
        texts.append(value.hex() if isinstance(value, float) else repr(value))
    return texts


@given(scene=scenes())
def test_a_scene_comes_back_from_its_file_to_the_last_bit(scene: Scene) -> None:
    read = Scene.from_toml(scene.to_toml())
    assert read == scene
    assert exact_texts(read) == exact_texts(scene)


@given(scene=scenes())
def test_a_scene_is_written_as_its_format_and_one_table_a_group(scene: Scene) -> None:
    lines = scene.to_toml().splitlines()
    assert lines[0] == "format = 1"
    assert [line for line in lines if line.startswith("[")] == [f"[{group}]" for group in GROUPS]
    for name in PARAMETERS:
        assert sum(line.startswith(f"{name} = ") for line in lines) == 1


@given(data=st.data())
def test_a_partial_file_keeps_the_defaults_of_the_rest(data: st.DataObject) -> None:
    scene = data.draw(scenes())
    kept = data.draw(st.sets(st.sampled_from(sorted(set(PARAMETERS) - {"code", "bits"}))))
    lines = [
        line
        for line in scene.to_toml().splitlines()
        if line.startswith(("[", "format")) or line.split(" = ")[0] in kept
    ]
    read = Scene.from_toml("\n".join(lines))
    for name in PARAMETERS:
        assert read.value(name) == (scene.value(name) if name in kept else Scene().value(name))


def test_a_file_with_nothing_but_its_format_is_the_default_scene() -> None:
    assert Scene.from_toml("format = 1") == Scene()
    assert Scene.from_toml("# words\r\nformat = 1\r\n[camera]\r\n") == Scene()


def test_whole_and_real_numbers_may_stand_for_each_other() -> None:
    text = "format = 1\n[camera]\niso = 200\nrows = 300.0\n"
    assert exact_texts(Scene.from_toml(text)) == exact_texts(Scene().replace(iso=200.0, rows=300))


def test_a_code_and_its_bits_may_stand_in_either_order() -> None:
    for lines in ("bits = 12\ncode = 4095", "code = 4095\nbits = 12"):
        scene = Scene.from_toml(f"format = 1\n[transmitter]\n{lines}")
        assert (scene.value("code"), scene.value("bits")) == (4095, 12)


@each_case(
    [
        ("", r"^This is not a scene file: it has no line 'format = 1'\.$"),
        ("[camera]\niso = 100", r"^This is not a scene file: it has no line 'format = 1'\.$"),
        ("format = 2", r"^The scene file has format 2; this version reads format 1\.$"),
        ("format = 0", r"^The scene file has format 0; this version reads format 1\.$"),
        ("format = '1'", r"^The scene file has format '1'; this version reads format 1\.$"),
        ("format = true", r"^The scene file has format True; this version reads format 1\.$"),
        ("format = []", r"^The scene file has format \[\]; this version reads format 1\.$"),
        ("format = 1\nformat = 1", r"^This is not a TOML file: Cannot overwrite .*\.$"),
        ("<xml/>", r"^This is not a TOML file: .*line 1.*\.$"),
        ("format = 1\n[camera\n", r"^This is not a TOML file: .*line 2.*\.$"),
        ("format = 1\n\0", r"^This is not a TOML file: .*\.$"),
        ("format = 1\n[film]\n", r"^A scene file has no table \[film\]; known are transmitter, "),
        ("format = 1\nfilm = 1\n", r"^A scene file has no table \[film\]; known are transmitter, "),
        ("format = 1\ncamera = 1\n", r"^camera must be a table: "),
        ("format = 1\n[[camera]]\niso = 100\n", r"^camera must be a table: "),
        ("format = 1\niso = 100\n", r"^A scene file has no table \[iso\]; "),
        (
            "format = 1\n[camera]\nexposure = 1e-3\n",
            r"^Table \[camera\]: There is no parameter 'exposure'; did you mean exposure_time\?$",
        ),
        (
            "format = 1\n[camera]\ndistance = 1.0\n",
            r"^Table \[camera\]: There is no parameter 'distance'; ",
        ),
        ("format = " + "[" * 5000, r"^This is not a scene file: it is nested too deeply\.$"),
        ("format = " + "9" * 5000, r"^This is not a TOML file: .*\.$"),
        ("format = 0x" + "f" * 5000, r"^The scene file has format .*; this version reads format 1"),
        *(
            (
                f"format = 1\n{part * 100_000}b = 1",
                r"^This is not a scene file: a key has more than ",
            )
            for part in ("a.", '"a".', '"\\"".', "'a'.", '"#".', "'\"'.")
        ),
        ("format = 1\n['a'" + ' . "b"' * 100 + "]", r"^This is not a scene file: a key has more "),
        ("format = 1\nx = {a" + ".a" * 100 + " = 1}", r"^This is not a scene file: a key has "),
        ("format = 1\n[" + "a" * 10**5 + "]", r"^A scene file has no table \[a{100,200}…\]; known"),
        ('format = 1\n["\\u001b[31m"]', r"^A scene file has no table \[\\x1b\[31m\]; known are "),
    ]
)
def test_a_text_that_is_no_scene_file_is_refused_in_a_sentence(text: str, sentence: str) -> None:
    with pytest.raises(SceneFileError, match=sentence):
        Scene.from_toml(text)


@each_case(
    [
        'title = "' + "e.g. a sentence. And another. " * 100 + '"',
        "# " + "." * 1000,
        "# 1.2.3.4.5.6.7.8.9.10.11.12.13.14.15.16.17.18.19.20",
        "a.b.c = 1\n" + "".join(f"k{number}.b = 1.5\n" for number in range(1000)),
        "x = [" + "1.5, " * 1000 + "]",
        "x = [" + "'a', " * 1000 + "]",
        *(f"x = {quote}{'1.' * 60}{quote}  # {'1.' * 60}" for quote in ('"', "'", '"""', "'''")),
    ]
)
def test_dots_in_texts_and_numbers_make_no_long_key(text: str) -> None:
    parse_toml(text)


@pytest.mark.parametrize("text", [None, 3, b"format = 1", ["format = 1"]])
def test_an_argument_that_is_no_text_is_refused_in_a_sentence(text: object) -> None:
    with pytest.raises(SceneFileError) as refused:
        Scene.from_toml(text)  # type: ignore[arg-type]
    assert str(refused.value) == (
        f"A scene is read from text (str), not from {type(text).__name__}."
    )
