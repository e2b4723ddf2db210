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
from hard_cases.fuzzing.mutations import encode_text, mutate_text
from hard_cases.fuzzing.target import FuzzTarget
from hard_cases.fuzzing.targets.typed import check_scene
from occ_model.files.resources import resource_names, resource_text
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.presets import USER_FOLDER as PRESETS, preset_from, presets, read_presets
from occ_model.scene.provenance import Provenance, first_scene_in
from occ_model.scene.recording import Recording, Waypoint
from occ_model.teaching.lessons import USER_FOLDER as LESSONS, lessons, read_lesson

_NAMES = ("scene", "photo 1", "a\x1b[31mb", "a\nb", "é", "a" * 200, "-", "phone-68us", "nul")
"""Names of files without their endings."""


@cache
def scene_texts() -> tuple[str, ...]:
    """Return the texts of some scene files."""
    own = occ.Scene().replace(payload='text:a "b" \\ é', line_code="manchester", framing="c-ook")
    scenes = (own, occ.Scene(), occ.load_preset("phone-136us-real"))
    return tuple(scene.to_toml() for scene in scenes)


@cache
def _texts_of(folder: str) -> tuple[str, ...]:
    """Return the texts of the package's presets or lessons."""
    return tuple(resource_text(folder, name + ".toml") for name in resource_names(folder, ".toml"))


def _read_scene(random: Random, folder: Path) -> list[str]:
    content = encode_text(random, mutate_text(random, random.choice(scene_texts())))
    path = folder / f"{random.choice(_NAMES)}.toml"
    path.write_bytes(content)
    check_scene(read_scene_file(path))
    return []


def _read_preset(random: Random, folder: Path) -> list[str]:
    text = mutate_text(random, random.choice((*_texts_of("presets"), *scene_texts())))
    preset = preset_from("own", text)
    check_scene(preset.scene)
    assert preset.title
    return []


def _list_own_files(random: Random, folder: Path) -> list[str]:
    """List the user's own presets and lessons, whatever their folder contains."""
    import pytest

    for kind in ("presets", "lessons"):
        text = mutate_text(random, random.choice(_texts_of(kind)))
        (folder / f"{random.choice(_NAMES)}.toml").write_bytes(encode_text(random, text))
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(PRESETS, str(folder))
        patch.setenv(LESSONS, str(folder))
        for name in presets():
            check_scene(occ.load_preset(name))
        problems = {**read_presets().problems, **lessons().problems}
    for name in problems:
        assert name.isprintable()
    return list(problems.values())


def _read_lesson(random: Random, folder: Path) -> list[str]:
    text = mutate_text(random, random.choice(_texts_of("lessons")))
    path = folder / f"{random.choice(_NAMES)}.toml"
    path.write_bytes(encode_text(random, text))
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


def _read_recording(random: Random, _folder: Path) -> list[str]:
    recording = Recording.from_text(mutate_text(random, _film_note()))
    if recording is None:
        return ["The note is damaged."]
    assert Recording.from_text("\n".join(recording.lines())) == recording
    return []


@cache
def exported_files() -> dict[str, bytes]:
    """Return a small file of each format that contains a scene."""
    from matplotlib.figure import Figure

    from occ_model.figures.drawing import figure_bytes, table_text

    scenes = {"of this file": occ.Scene(), "é (x) \\": occ.Scene().replace(pattern="10")}
    provenance = Provenance("A title & more", scenes, seed=1, notes=("a (note) \\",))
    files = {kind: figure_bytes(Figure((1, 1)), kind, provenance) for kind in ("svg", "pdf", "png")}
    files["csv"] = table_text(("a", "b"), [(1, 2)], provenance).encode()
    return files


def _read_exported(random: Random, folder: Path) -> list[str]:
    kind = random.choice(("svg", "pdf", "png", "csv"))
    content = exported_files()[kind]
    if kind == "png" and random.random() < 0.5:
        content = _png_with(random, mutate_text(random, _provenance_text()))
    elif kind == "png" or random.random() < 0.3:
        content = damage.damage_bytes(np.random.default_rng(random.getrandbits(32)), content)
    else:
        # Latin-1 maps each byte of a PDF to a letter.
        text = content.decode("latin-1" if kind == "pdf" else "utf-8")
        text = mutate_text(random, text)
        content = text.encode("latin-1", "replace") if kind == "pdf" else encode_text(random, text)
    path = folder / f"{random.choice(_NAMES)}.{kind}"
    path.write_bytes(content)
    check_scene(read_scene_file(path))
    return []


def _provenance_text() -> str:
    return Provenance("A title", {"of this file": occ.Scene()}, seed=1).text()


def _png_with(random: Random, text: str) -> bytes:
    """Return a picture with a text as its description, compressed or not."""
    notes, buffer = PngInfo(), io.BytesIO()
    write = notes.add_itxt if random.random() < 0.5 else notes.add_text
    text = text.encode("utf-8", "replace").decode()
    write("Description", text, zip=random.random() < 0.5)
    Image.new("L", (2, 2)).save(buffer, "PNG", pnginfo=notes)
    return buffer.getvalue()


def _read_provenance(random: Random, _folder: Path) -> list[str]:
    text = Provenance("Title", {"a": occ.Scene(), "b": occ.load_preset("phone-68us")}).text()
    scene = first_scene_in(mutate_text(random, text))
    if scene is not None:
        check_scene(scene)
    return []


_CASES = (
    _read_scene,
    _read_scene,
    _read_preset,
    _read_preset,
    _list_own_files,
    _read_recording,
    _read_provenance,
)


def _try_any(random: Random, folder: Path) -> list[str]:
    return random.choice(_CASES)(random, folder)


_REFUSALS = (occ.SceneFileError, occ.ParameterError, occ.PresetError)

SCENES = FuzzTarget(
    "scenes", "scene files, presets and their folder, the notes of films", _try_any, _REFUSALS,
    fraction=130,
)  # fmt: skip

LESSON_FILES = FuzzTarget(
    "lessons", "lessons' files", _read_lesson, (occ.SceneFileError,), fraction=60
)

EXPORTED = FuzzTarget(
    "exported files", "SVG, PDF, PNG and CSV files with a scene inside", _read_exported, _REFUSALS,
    fraction=80,
)  # fmt: skip
