"""Scene files, presets, lessons, the notes of films, and figures with a scene inside."""

import io
from functools import cache
from pathlib import Path
from random import Random

import damage
import numpy as np
from PIL import Image
from PIL.PngImagePlugin import PngInfo

import occ_model as occ
from hard_cases.attack import hostile
from hard_cases.attack.doors.typed import check_scene
from hard_cases.attack.promise import Door
from occ_model.files.resources import resource_names, resource_text
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.presets import USER_FOLDER as PRESETS, preset_from, presets, unreadable_presets
from occ_model.scene.provenance import Provenance, first_scene_in
from occ_model.scene.recording import Recording, Waypoint
from occ_model.teaching.lessons import USER_FOLDER as LESSONS, lessons, read_lesson

_NAMES = ("scene", "photo 1", "a\x1b[31mb", "a\nb", "é", "a" * 200, "-", "phone-68us", "nul")
"""Names of files without their endings."""


@cache
def scene_texts() -> tuple[str, ...]:
    """The texts of some scene files."""
    own = occ.Scene().replace(payload='text:a "b" \\ é', line_code="manchester", framing="c-ook")
    scenes = (own, occ.Scene(), occ.load_preset("phone-136us-real"))
    return tuple(scene.to_toml() for scene in scenes)


@cache
def _texts_of(folder: str) -> tuple[str, ...]:
    """The texts of the package's own presets or lessons."""
    return tuple(resource_text(folder, name + ".toml") for name in resource_names(folder, ".toml"))


def _scene(chance: Random, folder: Path) -> list[str]:
    content = hostile.encoded(chance, hostile.damaged(chance, chance.choice(scene_texts())))
    path = folder / f"{chance.choice(_NAMES)}.toml"
    path.write_bytes(content)
    check_scene(read_scene_file(path))
    return []


def _preset(chance: Random, folder: Path) -> list[str]:
    text = hostile.damaged(chance, chance.choice((*_texts_of("presets"), *scene_texts())))
    preset = preset_from("own", text)
    check_scene(preset.scene)
    assert preset.title
    return []


def _own_files(chance: Random, folder: Path) -> list[str]:
    """The folders of the user's own presets and lessons: whatever is in them, they are listed."""
    import pytest

    for kind in ("presets", "lessons"):
        text = hostile.damaged(chance, chance.choice(_texts_of(kind)))
        (folder / f"{chance.choice(_NAMES)}.toml").write_bytes(hostile.encoded(chance, text))
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(PRESETS, str(folder))
        patch.setenv(LESSONS, str(folder))
        for name in presets():
            check_scene(occ.load_preset(name))
        problems = {**unreadable_presets(), **lessons().problems}
    for name in problems:
        assert name.isprintable()
    return list(problems.values())


def _lesson(chance: Random, folder: Path) -> list[str]:
    text = hostile.damaged(chance, chance.choice(_texts_of("lessons")))
    path = folder / f"{chance.choice(_NAMES)}.toml"
    path.write_bytes(hostile.encoded(chance, text))
    lesson = read_lesson(path)
    assert lesson.title
    assert lesson.steps
    for step in lesson.steps:
        check_scene(step.scene)
        assert step.check is None or 0.0 <= step.check.tolerance <= 1.0
    return []


@cache
def _film_note() -> str:
    path = (Waypoint(0.0), Waypoint(1.0, offset_x=0.2, roll=0.1))
    recording = Recording(frame_jitter=1e-5, path=path, exposure_times=(1e-4, 2e-4))
    return "\n".join([*recording.lines(), *scene_texts()[0].splitlines()])


def _recording(chance: Random, _folder: Path) -> list[str]:
    recording = Recording.from_text(hostile.damaged(chance, _film_note()))
    if recording is None:
        return ["The note is damaged."]
    assert Recording.from_text("\n".join(recording.lines())) == recording
    return []


@cache
def exported() -> dict[str, bytes]:
    """A small file of each kind that carries a scene."""
    from matplotlib.figure import Figure

    from occ_model.figures.drawing import figure_bytes, table_text

    scenes = {"of this file": occ.Scene(), "é (x) \\": occ.Scene().replace(pattern="10")}
    provenance = Provenance("A title & more", scenes, seed=1, notes=("a (note) \\",))
    files = {kind: figure_bytes(Figure((1, 1)), kind, provenance) for kind in ("svg", "pdf", "png")}
    files["csv"] = table_text(("a", "b"), [(1, 2)], provenance).encode()
    return files


def _carrier(chance: Random, folder: Path) -> list[str]:
    kind = chance.choice(("svg", "pdf", "png", "csv"))
    content = exported()[kind]
    if kind == "png" and chance.random() < 0.5:
        content = _png_with(chance, hostile.damaged(chance, _provenance_text()))
    elif kind == "png" or chance.random() < 0.3:
        content = damage.damaged(np.random.default_rng(chance.getrandbits(32)), content)
    else:
        # Of a PDF as of bytes, each a letter.
        text = content.decode("latin-1" if kind == "pdf" else "utf-8")
        text = hostile.damaged(chance, text)
        content = (
            text.encode("latin-1", "replace") if kind == "pdf" else hostile.encoded(chance, text)
        )
    path = folder / f"{chance.choice(_NAMES)}.{kind}"
    path.write_bytes(content)
    check_scene(read_scene_file(path))
    return []


def _provenance_text() -> str:
    return Provenance("A title", {"of this file": occ.Scene()}, seed=1).text()


def _png_with(chance: Random, text: str) -> bytes:
    """A picture whose description, packed or not, is a text."""
    notes, buffer = PngInfo(), io.BytesIO()
    write = notes.add_itxt if chance.random() < 0.5 else notes.add_text
    text = text.encode("utf-8", "replace").decode()
    write("Description", text, zip=chance.random() < 0.5)
    Image.new("L", (2, 2)).save(buffer, "PNG", pnginfo=notes)
    return buffer.getvalue()


def _several(chance: Random, _folder: Path) -> list[str]:
    text = Provenance("Title", {"a": occ.Scene(), "b": occ.load_preset("phone-68us")}).text()
    scene = first_scene_in(hostile.damaged(chance, text))
    if scene is not None:
        check_scene(scene)
    return []


_WAYS = (_scene, _scene, _preset, _preset, _own_files, _recording, _several)


def _toml(chance: Random, folder: Path) -> list[str]:
    return chance.choice(_WAYS)(chance, folder)


_REFUSALS = (occ.SceneFileError, occ.ParameterError, occ.PresetError)

SCENES = Door(
    "scenes", "scene files, presets and their folder, the notes of films", _toml, _REFUSALS,
    fraction=130,
)  # fmt: skip

LESSONS_FILES = Door("lessons", "lessons' files", _lesson, (occ.SceneFileError,), fraction=60)

CARRIERS = Door(
    "exported files", "SVG, PDF, PNG and CSV files with a scene inside", _carrier, _REFUSALS,
    fraction=80,
)  # fmt: skip
