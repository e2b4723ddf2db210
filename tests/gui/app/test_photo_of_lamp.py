"""A lamp photographed, matched and applied: nothing in the window speaks of chips."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gui.user import User
from gui.visible_texts import visible_texts
from matplotlib.figure import Figure
from matplotlib.text import Text
from PIL import Image

import occ_model as occ
from occ_gui.app.application import Application
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene

LAMP: dict[str, ParameterValue] = {"light": "lamp", "lamp_frequency": 1e3, "duty": 0.54}
"""In fiftieths of its period, as it is fitted, it is 27 chips of 50 kHz."""


@pytest.fixture
def photo_path(tmp_path: Path, small_scene: Scene) -> Path:
    scene = small_scene.replace(
        **LAMP, rows=120, columns=1400, enhancement="none", averaging="light", distance=0.05,
        readout_time=9e-6, exposure_time=8e-5,
    )  # fmt: skip
    path = tmp_path / "lamp.png"
    exposed = Image.Exif()
    exposed.get_ifd(0x8769)[0x829A] = 8e-5
    Image.fromarray(occ.render(scene, tolerance=0.0).image).save(path, exif=exposed)
    return path


def check_says_no_chips_of_the_lamp(said: str) -> None:
    for wrong in (r"50(\.0+)? ?kHz", r"\b50000\b", r"\bchips?\b", "1{27}0{23}"):
        found = re.search(wrong, said)
        assert found is None, said[max(0, found.start() - 80) : found.end() + 80]


@pytest.mark.own_window
@pytest.mark.parametrize(
    "name", ["", pytest.param("iphone_1khz.jpg", marks=[pytest.mark.photos, pytest.mark.whole])]
)
def test_a_lamp_is_a_lamp_from_its_photo_to_the_figures_of_its_scene(
    application: Application, user: User, photo_path: Path, tmp_path: Path, name: str,
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    path = request.getfixturevalue("photos") / name if name else photo_path
    user.open_photo(path)
    form = application.view("photo").form
    form.lamp.set_value(1e3)
    form.sent.show_key("lamp")
    form.sent.chosen.emit("lamp")
    user.choose("&Match photo")
    match = application.shell.pane("photo").matching.match
    assert (match.lamp_frequency, match.duty) == (1e3, pytest.approx(0.54, abs=0.02))
    pane = "\n".join(visible_texts(application.view("photo")))
    verdict = application.view("photo").verdict.accessibleDescription()
    check_says_no_chips_of_the_lamp(f"{pane}\n{verdict}")
    user.choose("&Apply to the scene")
    sent = application.scene_store.scene.transmitter
    assert (sent.light, sent.lamp_frequency, sent.duty) == ("lamp", 1e3, match.duty)
    said = "\n".join(visible_texts(application.window))
    assert "kHz" in said
    check_says_no_chips_of_the_lamp(said)
    drawn: list[str] = []
    save = Figure.savefig

    def note(figure: Figure, *how: Any, **more: Any) -> None:
        drawn.extend(text.get_text() for text in figure.findobj(Text))
        save(figure, *how, **more)

    monkeypatch.setattr(Figure, "savefig", note)
    for figure in application.shell.different_figures:
        application.shell.pane("export").export(figure.name, tmp_path / f"{figure.name}.svg")
        user.wait_until_idle()
    assert "grey level" in drawn
    check_says_no_chips_of_the_lamp("\n".join(drawn))


def test_the_band_model_of_a_lamp_is_defined_where_the_exposure_is_shorter_than_its_pulse() -> None:
    """The exposure is longer than a fiftieth of the period, which the chips of its fit last."""
    scene = occ.load_preset("phone-68us").replace(**LAMP, exposure_time=8e-5)
    assert np.ptp(occ.band_profile(scene)) > 0.0
    assert occ.band_lengths(scene)[0] == pytest.approx((0.46e-3 - 8e-5) / scene.camera.readout_time)
    with pytest.raises(occ.BandModelUndefined):
        occ.band_profile(scene.replace(exposure_time=0.47e-3))
