"""What a match is asked and answers, and how it refuses."""

import math
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from simulated_photos import photo_of, random_scene, take

import occ_model as occ
from occ_model.cli import main
from occ_model.commands import match as match_command
from occ_model.files.writing import write_image
from occ_model.photo.evidence.candidates import Candidates
from occ_model.photo.fit.joint_model import ANY_GAMMA
from occ_model.program import EXIT_MISUSE

SCENE = random_scene(3)
KNOWN = SCENE.replace(readout_time=1e-6, exposure_time=1e-3, start_time=0.0)


FRACTIONS: list[float] = []


@cache
def the_photo() -> occ.Photo:
    return replace(take(SCENE), iso=640.0, f_number=1.8)


@cache
def matched() -> occ.Match:
    """Match the photo once for all who only look at what was found, or at the progress."""
    return occ.match_photo(the_photo(), KNOWN, progress=FRACTIONS.append)


def test_a_clear_photo_of_the_scene_is_sure_and_gives_no_reason() -> None:
    match = matched()
    assert (match.verdict, match.reasons) == ("sure", ())
    assert match.alternatives
    for other in match.alternatives:
        assert other.evidence < 0.0
        assert other.correlation <= match.correlation


def test_the_start_time_is_that_of_the_photo_not_of_the_region() -> None:
    inner = matched().region
    part = (0, the_photo().samples.shape[0], inner.first_column + 130, inner.last_column)
    late = occ.match_photo(the_photo(), KNOWN, region=part).start_time - matched().start_time
    period = 24.0 / SCENE.transmitter.switching_frequency
    assert abs((late + period / 2) % period - period / 2) < 0.01 * period


def test_the_fitted_scene_shows_the_photo_pixel_on_pixel() -> None:
    match = matched()
    frame = occ.render(match.scene, tolerance=math.inf)
    assert frame.image.shape == the_photo().samples.shape
    assert frame.corners.min(axis=0) == pytest.approx(
        (match.region.first_column - 0.5, match.region.first_row - 0.5), abs=0.01
    )
    seen = slice(match.region.first_column, match.region.last_column)
    comparison = occ.compare(match.stripes.flattened, frame.profile[seen])
    assert comparison.correlation > 0.99
    # Its levels are the photo's, in the middle of uneven light.
    assert np.median(frame.profile[seen]) == pytest.approx(np.median(match.profile), rel=0.2)


def test_the_fitted_scene_lies_on_the_photo_through_a_bent_lens() -> None:
    scene = SCENE.replace(radial_k1=0.15, tangential_p1=0.01)
    match = occ.match_photo(take(scene), scene.replace(readout_time=1e-6))
    again = occ.find_stripes(photo_of(occ.render(match.scene, tolerance=0.0).image)).region
    for name in ("first_row", "last_row", "first_column", "last_column"):
        assert getattr(again, name) == pytest.approx(getattr(match.region, name), abs=6)


def test_the_residual_is_the_photo_less_the_aligned_profile() -> None:
    match = matched()
    assert np.allclose(match.residual, match.stripes.profile - match.profile)
    assert match.rmse == pytest.approx(float(np.sqrt(np.mean(match.residual**2))))


def test_frequency_or_readout_time_is_estimated_from_the_other() -> None:
    readout, frequency = SCENE.camera.readout_time, SCENE.transmitter.switching_frequency
    one = matched()
    other = occ.match_photo(
        the_photo(),
        KNOWN.replace(readout_time=readout, switching_frequency=1e3),
        estimate="switching_frequency",
    )
    assert one.readout_time == pytest.approx(readout, rel=1e-4)
    assert other.switching_frequency == pytest.approx(frequency, rel=1e-4)
    assert set(one.uncertainties) == {"readout_time", "exposure_time", "start_time"}
    assert set(other.uncertainties) == {"switching_frequency", "exposure_time", "start_time"}


def test_an_unknown_code_is_read_as_the_packet_it_is() -> None:
    other = (SCENE.transmitter.code + 321) % 1024
    match = occ.match_photo(the_photo(), KNOWN.replace(code=other))
    assert match.pattern_was_read
    assert match.scene.transmitter.code == SCENE.transmitter.code
    assert match.scene.transmitter.pattern == ""
    late = match.start_time - SCENE.model.start_time
    period = 24.0 / SCENE.transmitter.switching_frequency
    assert (late + period / 2) % period - period / 2 == pytest.approx(0.0, abs=0.02 * period / 24)


def test_only_what_the_scene_sends_is_tried_where_that_is_asked() -> None:
    other = KNOWN.replace(code=(SCENE.transmitter.code + 321) % 1024)
    with pytest.raises(occ.MatchError, match="are not explained by what the scene sends"):
        occ.match_photo(the_photo(), other, sent="scene")


def test_what_never_changes_is_no_explanation() -> None:
    with pytest.raises(occ.MatchError, match="never changes"):
        occ.match_photo(the_photo(), KNOWN.replace(pattern="1111"), sent="scene")


def test_chips_without_a_possible_fit_are_not_said_never_to_change(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(Candidates, "as_sent", lambda _: None)
    with pytest.raises(occ.MatchError, match="does not explain the stripes, whenever"):
        occ.match_photo(the_photo(), KNOWN, sent="scene")


@pytest.mark.whole
def test_gamma_is_estimated_with_an_uncertainty_on_request() -> None:
    """More than half of what is not known before is told, whatever else bends the tone curve."""
    scene = random_scene(5).replace(averaging="light", gamma=1.8, illuminance=0.0)
    match = occ.match_photo(take(scene), scene.replace(gamma=2.4), fit_gamma=True)
    assert abs(match.gamma - 1.8) < 2.0 * match.uncertainties["gamma"]
    assert 0.0 < match.uncertainties["gamma"] < 0.5 * ANY_GAMMA * match.gamma
    assert match.scene.camera.gamma == match.gamma


def test_what_the_camera_noted_goes_into_the_scene() -> None:
    camera = matched().scene.camera
    assert (camera.iso, camera.f_number) == (the_photo().iso, the_photo().f_number)
    assert (camera.iso, camera.f_number) != (KNOWN.camera.iso, KNOWN.camera.f_number)


def test_the_averaging_that_explains_the_photo_is_found_or_given() -> None:
    assert matched().scene.model.averaging == SCENE.model.averaging
    given = occ.match_photo(the_photo(), KNOWN, averaging="pixel-value")
    assert given.scene.model.averaging == "pixel-value"


def test_progress_rises_to_1_and_what_it_raises_ends_the_match() -> None:
    matched()
    assert sorted(FRACTIONS) == FRACTIONS
    assert (FRACTIONS[0], FRACTIONS[-1]) == (0.0, 1.0)

    def stop(fraction: float) -> None:
        if fraction > 0.1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        occ.match_photo(the_photo(), KNOWN, progress=stop)


def test_stripes_that_no_parameter_explains_are_refused() -> None:
    with pytest.raises(occ.MatchError, match="not allowed: readout_time is"):
        occ.match_photo(the_photo(), KNOWN.replace(switching_frequency=1e9))


@pytest.mark.parametrize("seed", range(8))
def test_no_picture_crashes_a_match(seed: int) -> None:
    random = np.random.default_rng(seed)
    shape = tuple(random.integers(1, 200, 2).tolist())
    image = random.integers(0, 256, shape).astype(np.uint8)
    if seed % 4 == 1:
        image = np.sort(image, axis=1)
    if seed % 4 == 2:
        image = np.repeat(image[:1], shape[0], axis=0)
    if seed % 4 == 3:
        image = (image > 127).astype(np.uint8) * 255
    try:
        match = occ.match_photo(photo_of(image), KNOWN)
    except occ.MatchError:
        return
    assert match.correlation >= 0.8


class TestCommand:
    @pytest.fixture
    def file(self, tmp_path: Path) -> Path:
        path = tmp_path / "photo.png"
        write_image(path, the_photo().image)
        return path

    @pytest.fixture
    def known(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
        path = tmp_path / "scene.toml"
        path.write_text(KNOWN.to_toml(), encoding="utf-8")
        monkeypatch.setattr(match_command, "match_photo", lambda *_, **__: matched())
        return path

    def test_the_command_prints_what_was_found_with_uncertainties(
        self, file: Path, known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        fitted = tmp_path / "fitted.toml"
        assert main(["match", str(file), "--scene", str(known), "--out", str(fitted)]) == 0
        lines = capsys.readouterr().out
        assumed = r"if f = [\d.]+ kHz: "
        assert re.search(rf"readout_time +{assumed}[\d.]+ ± [\d.e-]+ µs", lines)
        assert re.search(rf"exposure_time +{assumed}", lines)
        assert re.search(r"switching_frequency .*\(assumed\)", lines)
        assert re.search(r"correlation +0\.9\d", lines)
        scene = occ.Scene.from_toml(fitted.read_text(encoding="utf-8"))
        assert scene.camera.readout_time == pytest.approx(SCENE.camera.readout_time, rel=1e-3)

    def test_what_rests_on_a_value_that_is_stated_has_no_condition(
        self, file: Path, known: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        stated = f"switching_frequency={KNOWN.transmitter.switching_frequency} Hz"
        assert main(["match", str(file), "--scene", str(known), "--set", stated]) == 0
        lines = capsys.readouterr().out
        assert re.search(r"readout_time +[\d.]+ ± [\d.e-]+ µs", lines)
        assert re.search(r"switching_frequency .*\(given\)", lines)
        assert "if switching" not in lines

    def test_what_cannot_be_matched_gives_a_sentence(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        path = tmp_path / "flat.png"
        write_image(path, np.full((50, 60), 90, np.uint8))
        assert main(["match", str(path)]) == EXIT_MISUSE
        assert "No stripes" in capsys.readouterr().err
