"""What sends or reads chips refuses every other light in one sentence; what only sees it does not.

The light is a scene's own, so that the same sentence is expected at every door.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from each_case import each_case
from exact_light import OTHER_LIGHTS

import occ_model as occ
from occ_model.cli import main
from occ_model.errors import ParameterError
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.light_words import describe_light
from occ_model.scene.scene import OBSERVABLES, Scene
from occ_model.study.cause.cause import cause_of
from occ_model.study.sweep.request_check import build_request

SCENE = occ.load_preset("phone-136us").replace(rows=40, columns=600)
SIGNAL = np.tile([10.0, 200.0], 300)
REFUSAL = "allowed where chips are sent or read: code; of this light, "
SEEN = "ask for its picture, its spectrum or its bars."


DOORS: dict[str, Callable[[Scene], object]] = {
    "packet": occ.packet,
    "success rate": lambda scene: occ.success_rate(scene, images=1),
    "sweep": lambda scene: occ.sweep(scene, {"distance": [1.0]}, images=1),
    "map": lambda scene: build_request(scene, {"iso": [1.0]}, RateSettings(1, ("threshold",))),
    "limits": occ.limits,
    "bit error rate": lambda scene: occ.bit_error_rate(scene, bits=10),
    "most bits": lambda scene: occ.most_bits(scene, ["threshold"]),
}
FILM_DOORS: dict[str, Callable[[Scene], object]] = {
    "film": lambda scene: occ.decode_video(occ.render_video(scene, 1), scene),
    "frames": lambda scene: occ.decode_frames([], scene),
}


@each_case(
    [
        *((door, light) for door in DOORS for light in OTHER_LIGHTS),
        # Films show the clock of all others.
        *((door, light) for door in FILM_DOORS for light in ("levels", "recorded")),
    ]
)
def test_what_needs_chips_refuses_the_light_and_names_what_to_ask(door: str, light: str) -> None:
    scene = SCENE.replace(**OTHER_LIGHTS[light])
    with pytest.raises(ParameterError) as refusal:
        (DOORS | FILM_DOORS)[door](scene)
    kind = scene.transmitter.light
    begin, instead = str(refusal.value).split(REFUSAL)
    assert (begin, instead) == (f"light is {kind}; ", SEEN)
    assert refusal.value.parameters == ("light",)


@each_case((decoder, light) for decoder in occ.decoders() for light in OTHER_LIGHTS)
def test_no_decoder_reads_a_code_from_another_light(decoder: str, light: str) -> None:
    scene = SCENE.replace(**OTHER_LIGHTS[light])
    for seen in (occ.render(scene).image, SIGNAL):
        result = occ.decode(seen, scene, decoder)
        assert result.failure is not None
        assert result.failure.endswith(SEEN)
        assert (result.code, result.bits.size, result.chips.size) == (None, 0, 0)
    cause = cause_of(scene, decoder)
    assert cause is not None
    assert (cause.what, cause.why) == ("no code is sent", result.failure)


@each_case(OTHER_LIGHTS)
def test_only_the_decision_of_the_observables_needs_a_code(light: str) -> None:
    scene = SCENE.replace(**OTHER_LIGHTS[light])
    for observable in OBSERVABLES:
        for tolerance in (0.0, 0.5, np.inf):
            if observable == "decision":
                with pytest.raises(ParameterError, match="choose the signal, the profile or the"):
                    occ.plan(scene, tolerance, observable)
            else:
                assert occ.plan(scene, tolerance, observable).error >= 0.0


@each_case(["duty", "pulse_length", "mains_depth", "levels", "lamp_frequency"])
def test_a_sweep_over_a_parameter_of_another_light_is_refused(name: str) -> None:
    value = SCENE.value(name)
    with pytest.raises(ParameterError, match=f"{name} cannot be varied: it belongs to the light "):
        occ.sweep(SCENE, {name: [value]}, images=1)


READING = [
    "sweep --vary distance=1 --images 1", "limits", "most-bits", "decode p.png",
    "decode p.png --decoder sequence", "decode film.mkv", "decode --follow film.mkv",
    "plan --observable decision",
]  # fmt: skip
SEEING = [
    "render -o q.png",
    "film --frames 2 -o film.mkv",
    "plan",
    "animate --vary iso=200,400 -o a.gif",
]


@pytest.mark.parametrize("light", OTHER_LIGHTS)
def test_commands_see_any_light_and_read_only_codes(
    light: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    scene = SCENE.replace(**OTHER_LIGHTS[light])
    sent = scene.transmitter
    Path("scene.toml").write_text(scene.to_toml(), encoding="utf-8")
    for command in SEEING:
        assert main([*command.split(), "--scene", "scene.toml"]) == 0, command
    Path("q.png").rename("p.png")
    kept = sorted(tmp_path.iterdir())
    capsys.readouterr()
    for command in READING:
        assert main([*command.split(), "--scene", "scene.toml"]) == 2, command
        printed = capsys.readouterr()
        assert printed.out == ""
        assert printed.err.startswith(f"occ-model: light is {scene.transmitter.light}; {REFUSAL}")
        assert printed.err.count("\n") == 1
    assert main(["decode", "film.mkv", "--set", "columns=600"]) == 1  # as of a code
    why = capsys.readouterr().err.splitlines()[-1]
    assert why.startswith(f"The film was simulated of this light: {describe_light(sent)}; it sends")
    assert sorted(tmp_path.iterdir()) == kept
