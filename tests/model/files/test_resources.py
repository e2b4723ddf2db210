"""The files that come with the package are found wherever it is imported from."""

import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

import occ_model as occ
from occ_model.files.resources import resource_names, resource_path, resource_text
from occ_model.teaching.lessons import lessons

ROOT = Path(occ.__file__).parent.parent


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Put the package into an archive, with its resources inside as a wheel has them."""
    path = tmp_path_factory.mktemp("archive") / "occ.zip"
    with zipfile.ZipFile(path, "w") as packed:
        for file in sorted((ROOT / "occ_model").rglob("*.py")):
            packed.write(file, file.relative_to(ROOT))
        for folder in ("docs", "lessons", "photos", "pictures", "presets", "rooms"):
            for file in sorted((ROOT / "resources" / folder).rglob("*.*")):
                packed.write(file, Path("occ_model", file.relative_to(ROOT)))
    return path


def run(archive: Path, program: str) -> list[str]:
    # Without the checkout, which stands in the path of an editable installation.
    start = f"import sys; sys.path.insert(0, {str(archive)!r})\n"
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", start + program],
        capture_output=True,
        text=True,
        check=False,
        cwd=archive.parent,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.splitlines()


def test_presets_are_loaded_out_of_an_archive(archive: Path) -> None:
    program = (
        "import occ_model as occ\n"
        "print(occ.__file__)\n"
        "for name in occ.presets(): print(name, hash(occ.load_preset(name).to_toml()) != 0)\n"
        "print(occ.load_preset('phone-136us').to_toml())\n"
    )
    file, *lines = run(archive, program)
    assert file.startswith(str(archive))
    count = len(occ.presets())
    assert [line.split()[0] for line in lines[:count]] == list(occ.presets())
    assert "\n".join(lines[count:]).strip() == occ.load_preset("phone-136us").to_toml().strip()


def test_lessons_are_loaded_out_of_an_archive(archive: Path) -> None:
    program = (
        "from occ_model.teaching.lessons import lessons\n"
        "for each in lessons().lessons: print(each.name, len(each.steps))\n"
    )
    here = [f"{each.name} {len(each.steps)}" for each in lessons().lessons]
    assert len(here) == 12
    assert run(archive, program) == here


def test_photos_of_an_archive_are_copied_until_the_program_ends(archive: Path) -> None:
    program = (
        "from occ_model.files.resources import resource_path\n"
        "folder = resource_path('photos')\n"
        "print(folder, *sorted(path.name for path in folder.glob('*.jpg')))\n"
        "print(len(resource_path('photos', 'led-1khz.jpg').read_bytes()))\n"
        "print(resource_path('photos', 'missing.jpg').exists())\n"
    )
    first, size, missing = run(archive, program)
    folder, *names = first.split()
    assert names == ["led-1khz.jpg", "packets-6khz.jpg"]
    assert int(size) == resource_path("photos", "led-1khz.jpg").stat().st_size
    assert missing == "False"
    assert not Path(folder).exists()


def test_pages_of_an_archive_are_copied_beside_their_pictures(archive: Path) -> None:
    program = (
        "from occ_model.files.resources import resource_path\n"
        "pictures, pages = resource_path('pictures'), resource_path('docs')\n"
        "print((pages / 'guide.md').is_file(), (pages / '../pictures/window.png').is_file())\n"
    )
    assert run(archive, program) == ["True True"]


TOOLS = {"packaging", "site"}
"""Folders that make something of the project, and which no running program reads."""


def test_a_wheel_has_every_folder_of_resources_inside() -> None:
    with (ROOT / "pyproject.toml").open("rb") as file:
        included = tomllib.load(file)["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    folders = [path.name for path in (ROOT / "resources").iterdir() if path.is_dir()]
    names = {name for name in folders if not name.startswith("__")} - TOOLS
    assert included == {f"resources/{name}": f"occ_model/resources/{name}" for name in names}


def test_the_command_line_runs_out_of_an_archive(archive: Path) -> None:
    program = "from occ_model.cli import main; sys.exit(main(['presets']))"
    assert [line.split()[0] for line in run(archive, program)] == list(occ.presets())


def test_resources_are_listed_and_read_here() -> None:
    assert "phone-136us" in resource_names("presets", ".toml")
    assert "devices" not in resource_names("presets", ".toml")
    assert resource_text("presets", "devices", "phone.toml").startswith(("format", "#", "title"))
    with pytest.raises(FileNotFoundError):
        resource_text("presets", "missing.toml")
