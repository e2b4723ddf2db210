"""Files named after ``occ-gui``, as a desktop names those that are double-clicked."""

from pathlib import Path

from occ_gui.app.command_line import _parser


def test_files_need_no_option() -> None:
    options = _parser().parse_args(["scene.occ.toml", "photo.jpg"])
    assert options.files == [Path("scene.occ.toml"), Path("photo.jpg")]
    assert _parser().parse_args([]).files == []
