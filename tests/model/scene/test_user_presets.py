"""The user's own presets: saving, listing and deleting them, and other files among them."""

from pathlib import Path

import pytest

from occ_model.cli import main
from occ_model.errors import OutputError, ParameterError, PresetError, SceneFileError
from occ_model.scene.presets import (
    USER_FOLDER,
    delete_preset,
    load_preset,
    preset_named,
    presets,
    read_presets,
    save_preset,
    user_folder,
    user_presets,
)
from occ_model.scene.scene import Scene


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Use a folder for the user's presets that does not exist yet."""
    folder = tmp_path / "own" / "presets"
    monkeypatch.setenv(USER_FOLDER, str(folder))
    return folder


MINE = Scene().replace(readout_time=14.565e-6, pattern="10", iso=321.0)


def test_a_saved_preset_keeps_its_scene_title_and_sources(own: Path) -> None:
    sources = {"readout_time": "measured: photo a.png"}
    path = save_preset("My phone", MINE, title="My phone's camera", sources=sources)
    assert path == own / "My phone.toml"
    preset = preset_named("My phone")
    assert (preset.scene, preset.title, preset.sources) == (MINE, "My phone's camera", sources)
    assert load_preset("My phone") == MINE
    assert list(own.iterdir()) == [path]


def test_the_users_presets_are_listed_after_the_programs(own: Path) -> None:
    built_in = presets()
    for name in ("b", "a 1", "zz"):
        save_preset(name, MINE)
    assert user_presets() == ("a 1", "b", "zz")
    assert presets() == (*built_in, "a 1", "b", "zz")
    assert preset_named("b").title == "b"


def test_saving_under_the_name_of_an_own_preset_replaces_it(own: Path) -> None:
    save_preset("mine", MINE)
    save_preset("mine", MINE.replace(iso=400.0))
    assert load_preset("mine").camera.iso == 400.0
    assert user_presets() == ("mine",)


@pytest.mark.parametrize(
    "name",
    ["", " a", "a ", ".a", "../a", "a/b", "a\\b", "a.b", "ä", "a\n", "a\0", "x" * 61, "NUL", 3],
)
def test_an_impossible_preset_name_is_refused_without_a_file(own: Path, name: object) -> None:
    with pytest.raises(PresetError, match=r"^A preset cannot be named ") as refused:
        save_preset(name, MINE)  # type: ignore[arg-type]
    assert str(refused.value).endswith(".")
    assert not own.exists()


@pytest.mark.parametrize("name", ["phone-136us", "PHONE-136us"])
def test_the_name_of_a_preset_of_the_program_is_refused(own: Path, name: str) -> None:
    with pytest.raises(PresetError, match=r"is a preset of the program; choose another name\.$"):
        save_preset(name, MINE)
    assert not own.exists()


def test_a_source_of_an_unknown_parameter_is_refused(own: Path) -> None:
    with pytest.raises(ParameterError, match="isoo"):
        save_preset("mine", MINE, sources={"isoo": "a book"})
    assert not own.exists()


def test_a_deleted_preset_is_gone(own: Path) -> None:
    save_preset("mine", MINE)
    delete_preset("mine")
    assert user_presets() == ()
    with pytest.raises(PresetError, match=r"^There is no preset 'mine'\."):
        load_preset("mine")
    with pytest.raises(PresetError, match=r"^There is no preset 'mine'\. Known are none\.$"):
        delete_preset("mine")


def test_a_preset_of_the_program_cannot_be_deleted(own: Path) -> None:
    with pytest.raises(PresetError, match="comes with the program"):
        delete_preset("phone-136us")
    assert "phone-136us" in presets()


HOSTILE: dict[str, bytes | str] = {
    "no toml": b"this is no preset",
    "bytes": b"\xff\xfe\x00",
    "title": "title = 5",
    "base": "based_on = 5",
    "elsewhere": "based_on = '../../elsewhere'",
    "itself": "based_on = 'itself'",
    "notes": "sources = 3",
    "note": "[sources]\niso = 3",
    "value": "[camera]\niso = -5.0",
    "deep key": "[sources]\n" + "a." * 1500 + "a = 1",
    "deep array": "title = " + "[" * 3000 + "]" * 3000,
    "long base": f"based_on = '{'a' * 10**5}'",
    "escapes": '["a\\u001b[31m\\n"]',
    "large": "#" * 2_000_000,
}
"""Contents of files that are no presets; texts follow the line of the format."""


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_preset_gets_a_short_reason_and_stops_nothing(
    own: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = presets()
    save_preset("good", MINE)
    content = HOSTILE[name]
    whole = content if isinstance(content, bytes) else f"format = 1\n{content}\n".encode()
    path = own / f"{name}.toml"
    path.write_bytes(whole)
    assert [preset.name for preset in read_presets().every] == [*before, "good"] == [*presets()]
    ((file, reason),) = read_presets().problems.items()
    assert file == name
    with pytest.raises((SceneFileError, ParameterError)) as refused:
        load_preset(name)
    assert reason == str(refused.value)
    assert str(path) in reason
    assert reason.isprintable()
    assert len(reason) < len(str(own)) + 2000
    assert main(["presets"]) == 0
    listed = capsys.readouterr().out.splitlines()
    assert listed[-1] == f"{name:20}cannot be used: {reason}"
    assert [line.split()[0] for line in listed[:-1]] == [*before, "good"]
    delete_preset(name)
    assert not path.exists()


def test_a_file_of_the_user_s_is_not_a_preset_of_the_program(own: Path) -> None:
    before = presets()
    own.mkdir(parents=True)
    (own / "phone-136us.toml").write_bytes(b"not the program's")
    (own / "a folder.toml").mkdir()
    assert presets() == before
    assert load_preset("phone-136us").camera.exposure_time == 136e-6


ODD_NAMES = {
    "Mon téléphone": "Mon téléphone",
    "a\nb": "a\\nb",
    "\x1b[31mred": "\\x1b[31mred",
    "no\udcffutf-8": "no\\udcffutf-8",
    "x" * 200: "x" * 200,
    "PHONE-136us": "PHONE-136us",
}


@pytest.mark.parametrize("name", ODD_NAMES)
def test_a_file_whose_name_no_preset_can_have_is_listed_as_such(
    own: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = presets()
    save_preset("good", MINE)
    (own / "good.toml").with_name(f"{name}.toml").write_bytes((own / "good.toml").read_bytes())
    assert presets() == (*before, "good")
    ((file, reason),) = read_presets().problems.items()
    assert file == ODD_NAMES[name]
    assert reason.endswith(".")
    assert reason.isprintable()
    assert main(["presets"]) == 0
    listed = capsys.readouterr().out.splitlines()
    assert listed[-1] == f"{file:20}cannot be used: {reason}"
    assert len(listed) == len(before) + 2


def test_hidden_files_of_editors_and_systems_are_not_listed(own: Path) -> None:
    save_preset("good", MINE)
    (own / "._good.toml").write_bytes(b"\0\5\26\7")
    (own / ".#good.toml").symlink_to("somebody@somewhere.1")
    assert user_presets() == ("good",)
    assert read_presets().problems == {}


def test_a_folder_and_a_link_to_nothing_are_listed_as_unreadable(own: Path) -> None:
    own.mkdir(parents=True)
    (own / "a folder.toml").mkdir()
    (own / "link.toml").symlink_to("nowhere")
    assert user_presets() == ()
    reasons = read_presets().problems
    assert reasons["a folder"] == f"{own / 'a folder.toml'} cannot be read: it is a folder."
    assert reasons["link"].endswith("cannot be read: No such file or directory.")


def test_control_characters_of_titles_and_notes_are_escaped(
    own: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = "\x1b[31mred\n\x1b]0;title\x07 \u202e\x9b"
    save_preset("mine", MINE, title=text, sources={"iso": text})
    for arguments in (["presets"], ["presets", "mine"]):
        assert main(arguments) == 0
        printed = capsys.readouterr().out
        assert "\\x1b[31mred\\n\\x1b]0;title\\x07 \\u202e\\x9b" in printed
        assert all(line.isprintable() for line in printed.split("\n"))
    assert "iso  " in printed


def test_an_own_preset_may_be_based_on_one_of_the_program(own: Path) -> None:
    own.mkdir(parents=True)
    (own / "mine.toml").write_text(
        'format = 1\nbased_on = "phone-136us"\ntitle = "Mine"\n[camera]\niso = 400\n'
        '[sources]\niso = "my camera"\n'
    )
    mine = preset_named("mine")
    assert mine.scene == load_preset("phone-136us").replace(iso=400)
    assert mine.sources["iso"] == "my camera"
    assert mine.sources["readout_time"].startswith("paper, ")


def test_a_preset_that_cannot_be_written_says_so(own: Path) -> None:
    own.parent.mkdir()
    own.write_text("a file where the folder should be")
    with pytest.raises(OutputError, match=r"\.$"):
        save_preset("mine", MINE)
    assert presets() == tuple(sorted(presets()))


def test_a_title_that_utf_8_cannot_write_is_saved_with_question_marks(own: Path) -> None:
    save_preset("mine", MINE, title="photo \udcff.png")
    assert preset_named("mine").title == "photo ?.png"


def test_the_users_folder_is_the_systems_by_default(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv(USER_FOLDER)
    assert user_folder().is_absolute()
    assert user_folder().parts[-2:] == ("occ-explorer", "presets")
