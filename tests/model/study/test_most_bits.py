"""The scheme that is found is read, and schemes that would carry more bits are not."""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

import occ_model as occ
from occ_model.cli import main
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.study.most_bits import VARIED_PARAMETERS, list_candidates, make_example, reset_varied

FAR = occ.load_preset("phone-136us").replace(rows=60, enhancement="none", distance=3.0)


def test_the_combination_that_carries_most_is_tried_first() -> None:
    bits = [one.bits for one in list_candidates(FAR)]
    assert bits == sorted(bits, reverse=True)
    assert len(bits) > 50


def test_the_scene_found_is_read_and_its_bits_are_counted() -> None:
    (found,) = occ.most_bits(FAR, ("threshold",), frames_a_second=20.0, pictures=2)
    length = found.scene.transmitter.payload_length
    assert found.bits_a_second == 20.0 * length
    assert found.scene.camera == FAR.camera
    assert occ.bit_error_rate(found.scene, "threshold", 2 * length).rate < 0.5
    chosen = {name: found.scene.value(name) for name in VARIED_PARAMETERS}
    assert FAR.replace(**chosen) == found.scene
    assert reset_varied(found.scene) == reset_varied(FAR)
    example = make_example(found)
    assert example.transmitter.payload_length == length
    read = occ.decode(occ.render(example).image, example, decoder="threshold")
    assert read.failure is None
    assert f"bits:{''.join(map(str, read.bits))}" == example.transmitter.payload


def test_bits_that_the_decoder_rejects_carry_nothing(
    offer_decoders: Callable[..., None],
) -> None:
    def read(failure: str | None, _: object, scene: Scene) -> DecodeResult:
        bits = np.array(scene.transmitter.payload_bits, dtype=np.uint8)
        return DecodeResult("any", bits=bits, code=0, failure=failure)

    offer_decoders(
        sure=partial(read, None), unsure=partial(read, "The chips are not certain enough.")
    )
    found, nothing = occ.most_bits(FAR, ("sure", "unsure"), pictures=1)
    assert found.scene is not None
    assert nothing.scene is None
    assert nothing.bits_a_second == 0.0


def test_a_panel_too_far_away_carries_nothing() -> None:
    (found,) = occ.most_bits(FAR.replace(distance=2000.0), ("threshold",), pictures=1)
    assert found.scene is None
    assert found.bits_a_second == 0.0
    assert "come closer" in (found.failure or "")


def test_coming_closer_is_not_advised_if_the_panel_is_out_of_the_picture() -> None:
    (found,) = occ.most_bits(FAR.replace(offset_x=50.0), ("threshold",), pictures=1)
    assert found.failure == "No column of the picture shows the panel."


def test_overexposure_is_stated_first() -> None:
    (found,) = occ.most_bits(FAR.replace(iso=6400.0, illuminance=30e3), ("threshold",), pictures=1)
    assert (found.failure or "").startswith("Overexposed. Even the dark panel would have the level")


def test_the_command_states_what_carries_most(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--set", "rows=60", "--set", "distance=3", "--set", "enhancement=none"]
    assert main(["most-bits", *words, "--decoder", "threshold", "--pictures", "2"]) == 0
    head, found, theory = capsys.readouterr().out.splitlines()
    assert "30 pictures a second" in head
    assert "bits a second" in found
    assert "29.41 kHz" in theory
