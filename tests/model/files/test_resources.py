"""The files of the package are found wherever it is imported from."""

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
    """Pack the package into an archive with its resources inside, as in a wheel."""
    path = tmp_path_factory.mktemp("archive") / "occ.zip"
    with zipfile.PyZipFile(str(path), "w") as packed:
        packed.writepy(str(ROOT / "occ_model"))  # already compiled
        packed.write(ROOT / "occ_model" / "__init__.pyi", "occ_model/__init__.pyi")
        for folder in ("docs", "lessons", "photos", "pictures", "presets", "rooms"):
            for file in sorted((ROOT / "resources" / folder).rglob("*.*")):
                packed.write(file, Path("occ_model", file.relative_to(ROOT)))
    return path


def test_all_resources_in_an_archive_are_found(archive: Path) -> None:
    """Presets and lessons are read; photos and pages are copied until the program ends."""
    program = f"""
import sys
sys.path.insert(0, {str(archive)!r})  # without the checkout, which an editable installation names
import occ_model as occ
from occ_model.cli import main
from occ_model.files.resources import resource_path
from occ_model.teaching.lessons import lessons
photos, pages, pictures = map(resource_path, ("photos", "docs", "pictures"))
print(occ.__file__, photos)
print(*occ.presets())
assert occ.load_preset("phone-136us").camera.exposure_time == 136e-6
print(*[len(each.steps) for each in lessons().lessons])
print(*sorted(path.name for path in photos.glob("*.jpg")))
print(len((photos / "led-1khz.jpg").read_bytes()), resource_path("photos", "missing.jpg").exists())
print((pages / "guide.md").is_file(), (pages / "../pictures/window.png").is_file())
sys.exit(main(["presets"]))
"""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        capture_output=True, text=True, check=False, cwd=archive.parent,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    places, presets, steps, photos, photo, pages, *listed = map(str.split, done.stdout.splitlines())
    assert places[0].startswith(str(archive))
    assert not Path(places[1]).exists()
    assert presets == list(occ.presets()) == [words[0] for words in listed]
    assert [int(count) for count in steps] == [len(each.steps) for each in lessons().lessons]
    assert photos == ["led-1khz.jpg", "packets-6khz.jpg"]
    assert photo == [str(resource_path("photos", "led-1khz.jpg").stat().st_size), "False"]
    assert pages == ["True", "True"]


TOOLS = {"packaging", "site"}
"""Folders used to build the project, which the running program does not read."""


def test_a_wheel_has_every_folder_of_resources_inside() -> None:
    with (ROOT / "pyproject.toml").open("rb") as file:
        included = tomllib.load(file)["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    folders = [path.name for path in (ROOT / "resources").iterdir() if path.is_dir()]
    names = {name for name in folders if not name.startswith("__")} - TOOLS
    assert included == {f"resources/{name}": f"occ_model/resources/{name}" for name in names}


def test_resources_are_listed_and_read_here() -> None:
    assert "phone-136us" in resource_names("presets", ".toml")
    assert "devices" not in resource_names("presets", ".toml")
    assert resource_text("presets", "devices", "phone.toml").startswith(("format", "#", "title"))
    with pytest.raises(FileNotFoundError):
        resource_text("presets", "missing.toml")
