"""Ask every question about scenes at the ends of the parameters' ranges, in a process of its own.

``python tests/hard_cases/range_ends.py FIRST STEP`` asks them about every STEP-th case from FIRST
on. It prints as JSON the number of cases and questions, the failures, and the questions that needed
the most memory and time. Before each question it prints the case and the question, so that the last
line names the one during which the process ended.
"""

import io
import json
import resource
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import asdict, dataclass, field
from functools import lru_cache, partial
from itertools import combinations, islice, product
from pathlib import Path
from tempfile import TemporaryDirectory

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

import occ_model as occ
from hard_cases.fuzzing.program import OutOfTime, peak_megabytes, place_of, time_bound
from hard_cases.fuzzing.target import check_sentence
from occ_model.boards.sketch import BOARDS
from occ_model.cli import main
from occ_model.figures.bands import bands_drawing, flicker_drawing
from occ_model.receiver.decode import DECODERS
from occ_model.scene.canonical_text import CanonicalText
from occ_model.scene.light_samples import MOST_LEVELS, MOST_SAMPLES
from occ_model.scene.parameter_kinds import ChipPattern, Choice, ParameterValue, Payload
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, OBSERVABLES, Scene
from occ_model.study import theory
from occ_model.study.bands.advice import cure_of
from occ_model.study.bands.least_depth import depth_map
from occ_model.study.cause.cause import cause_of
from occ_model.study.spectrum import profile_spectrum
from occ_model.teaching.equations import equations
from occ_model.teaching.light_over_columns import (
    exposure_window,
    light_over_columns,
    rolling_shutter,
)
from occ_model.teaching.marked_values import marked_values
from occ_model.teaching.packet_fields import packet_fields
from occ_model.teaching.quantities import QUANTITIES

Case = Mapping[str, ParameterValue]

PATIENCE = 60.0  # seconds of processor time after which a question counts as endless
MEMORY = 1500.0  # megabytes that the process may have during any question

_LONGEST_PAYLOAD = "bits:" + "1101" * 1024

_MULTIPLIED = (
    "switching_frequency", "exposure_time", "readout_time", "flicker_frequency", "edge_time",
    "start_time", "rows", "columns", "pattern", "payload", "point_spread", "distance",
    "panel_width", "panel_height", "equivalent_focal_length",
)  # fmt: skip
"""Frequencies, times and sizes whose products are numbers of chips, columns or pixels."""

_CANONICAL_TEXTS = {
    "levels": ("0", f"{' '.join(map(str, range(MOST_LEVELS)))} / {MOST_LEVELS}"),
    "waveform_file": (
        "0,1\n1e-300,0\n1\n",
        "".join(f"{second},{second % 7 / 7}\n" for second in range(MOST_SAMPLES)),
    ),
    "mixing": ("0.01 0 0 0 1 0 0 0 1", "1 1 1 1 1 0.99 1 0.9 0"),
}  # fmt: skip


def base() -> Scene:
    """Return the scene of a small picture with every effect of a real camera."""
    scene = occ.load_preset("phone-136us-real")
    return scene.replace(rows=240, columns=320, readout_time=25e-6, distance=0.5)


def ends(name: str) -> tuple[ParameterValue, ...]:
    """Return the ends of a parameter's range, or all its words."""
    declared = PARAMETERS[name]
    if isinstance(declared, Choice):
        return declared.choices
    if isinstance(declared, ChipPattern):
        return "", ("1101" * declared.most)[: declared.most]
    if isinstance(declared, CanonicalText):
        return _CANONICAL_TEXTS[name]
    if isinstance(declared, Payload):
        return "bits:1", _LONGEST_PAYLOAD
    return declared.low, declared.high


def cases() -> list[Case]:
    """Return the ends of each parameter and of pairs that multiply, and the longest packets."""
    alone = [{**_where_it_matters(name), name: end} for name in PARAMETERS for end in ends(name)]
    paired = [
        {one: end, other: other_end}
        for one, other in combinations(_MULTIPLIED, 2)
        for end, other_end in product(ends(one), ends(other))
    ]
    sent = [{"payload": _LONGEST_PAYLOAD, "line_code": code, "framing": framing}
            for code, framing in product(ends("line_code"), ends("framing"))]  # fmt: skip
    long = [{**each, "switching_frequency": end}
            for each, end in product(sent, ends("switching_frequency"))]  # fmt: skip
    return [*alone, *paired, *long]


def _where_it_matters(name: str) -> Case:
    """Return the settings without which a parameter has no effect: its light, a colour camera."""
    lights = PARAMETERS[name].lights
    colour: Case = {"bayer": "rggb", "averaging": "light"} if name in GROUPS["colours"] else {}
    return {"light": lights[0] if lights else "code", **colour}


@lru_cache(maxsize=2)
def _frame(scene: Scene) -> occ.Frame:
    return occ.render(scene)


@lru_cache(maxsize=1)
def _film() -> occ.Video:
    return occ.render_video(base(), 2)


def _run_command(name: str, scene: Scene) -> None:
    with TemporaryDirectory() as folder:
        path = Path(folder, "scene.toml")
        path.write_text(scene.to_toml(), encoding="utf-8")
        with redirect_stdout(io.StringIO()) as written, redirect_stderr(io.StringIO()) as refused:
            status = main([name, "--scene", str(path)])
    if status:
        raise occ.OccError(refused.getvalue().strip())
    assert written.getvalue()


def _ask_theory(scene: Scene) -> None:
    theory.gaussian_rate_bound(scene, 100.0, 30.0)
    for of_scene in (
        theory.panel_readout_time, theory.row_rate_frequency, theory.saturation_exposure,
        # Those of chips are last, as another light has none.
        theory.two_packets_frequency, theory.band_model_frequency, theory.null_frequency,
    ):  # fmt: skip
        of_scene(scene)


def _ask_teaching(scene: Scene) -> None:
    equations(scene)
    packet_fields(scene)
    light_over_columns(scene, 0.0, float(scene.camera.columns), 2000)
    exposure_window(scene, scene.camera.columns - 1)
    rolling_shutter(scene)
    for name in ("switching_frequency", "exposure_time"):
        marked_values(scene, name)


def questions() -> dict[str, Callable[[Scene], object]]:
    """Return the questions about a scene, by name."""
    quantities = {
        f"quantity {name}": each.compute
        for name, each in QUANTITIES.items()
        if not each.of_photo and name != "threshold-limit"  # a search of many pictures
    }
    return {
        "draft": lambda scene: occ.render(
            scene, tolerance=0.0, rows_step=min(5, scene.camera.rows)
        ),
        "picture": lambda scene: occ.render(scene, tolerance=0.0),
        **{f"plan {each}": partial(occ.plan, observable=each) for each in OBSERVABLES},
        **{f"decode {each}": partial(_decode, decoder=each) for each in DECODERS},
        **{f"read a photo {each}": partial(_read_photo, decoder=each) for each in DECODERS},
        **{f"cause {each}": partial(cause_of, decoder=each) for each in DECODERS},
        **{f"success {each}": partial(_success, decoder=each) for each in DECODERS},
        **{f"decode colours {each}": partial(_decode_colours, decoder=each) for each in DECODERS},
        "bit errors": lambda scene: occ.bit_error_rate(scene, "threshold", bits=20),
        "bands": partial(_run_command, "bands"),
        "map of bars": depth_map,
        "no bars": lambda scene: cure_of(scene, 1e-6),
        "figure of bars": lambda scene: list(bands_drawing(scene).rows()),
        "figure of flicker": lambda scene: list(flicker_drawing(scene).rows()),
        "band model": occ.band_profile,
        "spectrum": lambda scene: profile_spectrum(occ.column_profile(scene), scene),
        "on time": occ.on_time,
        "theory": _ask_theory,
        "teaching": _ask_teaching,
        **quantities,
        "film": lambda scene: list(islice(occ.render_video(scene, 3), 3)),
        "read a film": lambda scene: occ.decode_video(_film(), scene),
        **{f"sketch {each}": partial(occ.transmitter_sketch, board=each) for each in BOARDS},
    }


def _decode(scene: Scene, decoder: str) -> None:
    occ.decode(_frame(scene).image, scene, decoder)


def _read_photo(scene: Scene, decoder: str) -> None:
    """Decode a picture that is not the scene's, with its settings, as a photo."""
    occ.decode(_frame(base()).image, scene, decoder)


def _decode_colours(scene: Scene, decoder: str) -> None:
    occ.decode_colours(occ.render_colour(scene, tolerance=0.0).image, scene, decoder)


def _success(scene: Scene, decoder: str) -> None:
    occ.success_rate(scene, images=1, decoder=decoder)


@dataclass
class Answers:
    """The answers to all questions: number, refusals, failures, and the largest cost."""

    cases: int = 0
    asked: int = 0
    refused: int = 0
    failures: dict[str, str] = field(default_factory=dict)
    most_megabytes: tuple[float, str] = (0.0, "")
    most_seconds: tuple[float, str] = (0.0, "")


def ask_all(asked: list[Case]) -> Answers:
    """Ask all questions about some cases."""
    found = Answers()
    for case in asked:
        found.cases += 1
        shown = " ".join(f"{name}={str(value)[:20]}" for name, value in case.items())
        try:
            scene = base().replace(**case)
        except occ.OccError as refusal:
            check_sentence(str(refusal))
            found.refused += 1
            continue
        for name, question in questions().items():
            _ask(found, f"{shown}: {name}", partial(question, scene))
    return found


def _ask(found: Answers, what: str, question: Callable[[], object]) -> None:
    print(what, flush=True)  # noqa: T201
    found.asked += 1
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")  # forgets the peak
    begun = time.process_time()
    try:
        with time_bound(PATIENCE):
            question()
    except occ.OccError as refusal:
        check_sentence(str(refusal))
        found.refused += 1
    except (Exception, OutOfTime) as fault:  # noqa: BLE001 - reported below
        found.failures[what] = f"{type(fault).__name__}: {str(fault)[:300]} {place_of(fault)}"
    found.most_seconds = max(found.most_seconds, (time.process_time() - begun, what))
    found.most_megabytes = max(found.most_megabytes, (peak_megabytes(), what))


def _report(lines: Iterator[str]) -> None:
    first, step = (int(word) for word in lines)
    # A question that needs more memory fails, and does not slow down the whole machine.
    most = round(2.0 * MEMORY * 1e6)
    resource.setrlimit(resource.RLIMIT_DATA, (most, most))
    print(json.dumps(asdict(ask_all(cases()[first::step]))))  # noqa: T201


if __name__ == "__main__":
    _report(iter(sys.argv[1:]))
