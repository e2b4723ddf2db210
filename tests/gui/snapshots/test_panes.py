"""The drawn panes look like their stored pictures.

`pytest tests/gui/snapshots --renew-snapshots` stores the pictures anew. That is right when a
change of the look was wanted, or a new version of Qt or pyqtgraph draws the same otherwise, and
only after both pictures were looked at. The new pictures are a commit of their own, which says
what looks different and why. It is wrong where a test fails for a reason that nobody knows.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from accuracy_points import EACH_WAY
from camera_measurements import make_measurement
from gui.kinds import SnapshotOf
from gui.photo.photo_bench import shown_photo
from gui.snapshots.gallery import Gallery
from matches import match_with
from PIL import Image

from occ_gui.accuracy.accuracy_view import AccuracyView
from occ_gui.bands.bands_view import BandsView
from occ_gui.bands.jobs import answer_question, compute_bars
from occ_gui.bench.bench_view import PUBLISHED, BenchChoice, BenchView
from occ_gui.bench.pane import request_of
from occ_gui.camera.camera_dialog import CameraDialog
from occ_gui.camera.jobs import CameraAnswer, CameraQuestion
from occ_gui.decoding.decode_view import DecodeView
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.rate_map import LINES, RateMap, TheoryFields, make_lattice
from occ_gui.explanation.pane import ExplanationView
from occ_gui.help.help_window import HelpWindow
from occ_gui.photo.match_result import MatchResult
from occ_gui.photo.photo_view import PhotoView
from occ_gui.picture.image_view import ImageView
from occ_gui.profile.profile_view import ProfileView
from occ_gui.welcome.welcome import WelcomeDialog
from occ_model.photo.reading.load import Photo
from occ_model.results.accuracy import Forecast, MeasuredCosts, TimeFractions
from occ_model.results.bit_errors import BenchPoint, BitErrors
from occ_model.results.match import Alternative
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.effect_differences import CompleteSimulation
from occ_model.teaching.equations import equations
from occ_model.teaching.light_over_columns import exposure_window


def test_the_picture_looks_as_stored(gallery: Gallery, snapshot_of: SnapshotOf) -> None:
    view = gallery.show(ImageView(), 480, 260)
    view.show_snapshot(snapshot_of())
    gallery.compare(view, "picture")


def test_the_profile_looks_as_stored(gallery: Gallery, snapshot_of: SnapshotOf) -> None:
    view = gallery.show(ProfileView(), 560, 260)
    view.show_reading(snapshot_of())
    gallery.compare(view, "profile")


def test_the_steps_of_each_decoder_look_as_stored(
    gallery: Gallery, snapshot_of: SnapshotOf
) -> None:
    view = gallery.show(DecodeView(), 380, 560)
    snapshot = snapshot_of()
    view.show_reading(snapshot)
    for place, result in enumerate(snapshot.results.values()):
        view.decoders.setCurrentIndex(place)
        gallery.compare(view, f"decode-{result.decoder}")


def test_the_map_looks_as_stored(gallery: Gallery, small_scene: Scene) -> None:
    view = gallery.show(MapView(("threshold", "matched")), 640, 280)
    x, y = make_lattice("switching_frequency", 13), make_lattice("distance", 7)
    rates = RateMap("switching_frequency", "distance", x, y, ("threshold", "matched"))
    points = [(column, row) for column in range(13) for row in range(7)]
    known = [
        SweepPoint(number, 10, right, "", tuple(int(count == 10) for count in right))
        for number, (column, row) in enumerate(points)
        if row < 6
        for right in [(max(0, 10 - column), max(0, 10 - abs(column + row - 9)))]
    ]
    refused = [
        SweepPoint(number, 0, (0, 0), "The panel is behind the camera.", (0, 0))
        for number, (_, row) in enumerate(points)
        if row == 6
    ]
    rates.enough_images = 5
    rates.enter([*known, *refused], 1)
    rates.enter([point for point in known if point.index < 42], 5, first=1)
    places = np.linspace(0.0, 1.0, 5), np.linspace(0.0, 1.0, 5)
    slope = places[0][:, None] + 0.2 * places[1]
    sides = {line: slope - 0.22 * place for place, line in enumerate(LINES, 1)}
    rates.theory = TheoryFields(places, sides)
    view.show_map(rates)
    view.show_scene(small_scene)
    view.show_progress(len(points), len(points), 1, 5)
    gallery.compare(view, "map")


def test_the_accuracy_looks_as_stored(gallery: Gallery, snapshot_of: SnapshotOf) -> None:
    measured = snapshot_of(edge_time=5e-6, vignetting_exponent=2.0)
    # What a clock has measured is another each time.
    timings = {name: 1e-3 * place for place, name in enumerate(sorted(measured.frame.timings), 1)}
    snapshot = replace(measured, frame=replace(measured.frame, timings=timings))
    view = gallery.show(AccuracyView(), 1300, 280)
    view.show_settings(SimulationSettings())
    view.show_snapshot(snapshot)
    complete = CompleteSimulation(snapshot.request.scene, "image")
    differences = {name: complete.without(name) for name in complete.effects}
    picture = TimeFractions.of(snapshot.frame)
    costs = MeasuredCosts(picture, differences=differences, errors=complete.errors)
    view.show_costs(snapshot.request, costs)
    expected = Forecast(snapshot.frame.plan, 0.045, 0.0, is_measured=True)
    view.show_forecast(snapshot.request, expected)
    view.plot.show_study_begun()
    for number, point in enumerate(EACH_WAY, 1):
        view.plot.show_point(point, number, len(EACH_WAY))
    view.plot.show_study_finished()
    gallery.compare(view, "accuracy")


def test_a_doubtful_match_looks_as_stored(
    gallery: Gallery, small_scene: Scene, photo: Photo
) -> None:
    view = gallery.show(MatchResult(), 360, 460)
    view.more.setChecked(True)
    other = Alternative("the scene's chips", "1100", 0.95, -3.21, 7.2e-6, 2e3, 8e-5)
    match = match_with(
        scene=small_scene,
        reasons=("Only 1.2 periods of 4 chips are in view; at least 3 are needed.",),
        alternatives=(other,),
    )
    shown = shown_photo(replace(photo, exposure_time=7.9e-5), small_scene, match)
    view.show_photo(shown)
    gallery.compare(view, "match-doubtful")
    view.show_photo(replace(shown, part=match.region))
    gallery.compare(view, "match-outdated")


def test_the_bench_looks_as_stored(gallery: Gallery, small_scene: Scene) -> None:
    decoders = ("threshold", "sequence")
    view = gallery.show(BenchView(decoders, decoders), 640, 420)
    view.show_begun(request_of(BenchChoice(PUBLISHED, decoders, 1000), small_scene))
    view.show_points(
        [
            BenchPoint(
                "manchester", "exposure", exposure, 30.0,
                BitErrors(decoder, 1000, wrong, wrong / 1400, (wrong + 9) / 900, 10,
                          10 - wrong // 100, 0.0, 1.0, 0.01, 0.02),
                "",
            )
            for step, exposure in enumerate((0.5, 1.0, 2.0, 4.0))
            for decoder, wrong in (("threshold", 250 * step + 20), ("sequence", 30 * step + 2))
        ]
    )  # fmt: skip
    view.show_ended("")
    gallery.compare(view, "bench")


def test_the_bars_look_as_stored(gallery: Gallery, small_scene: Scene) -> None:
    view = gallery.show(BandsView(), 760, 620)
    lamp = small_scene.replace(pattern="1110", switching_frequency=800.0, exposure_time=2e-3)
    view.show_bands(compute_bars(lamp))
    view.lamp.show_answer(answer_question(view.lamp.form.question))
    view.lamp.answer.more.click()
    gallery.compare(view, "bands")


def test_the_dialog_of_the_camera_looks_as_stored(gallery: Gallery) -> None:
    dialog = gallery.show(CameraDialog(), 640, 560)
    light = np.clip(make_measurement().waves.T[:, 2:5].repeat(40, axis=1) * 150.0 + 120.0, 0, 255)
    question = CameraQuestion((Path("one.jpg"), Path("two.jpg")), 50.0)
    pictures = tuple(each.astype(np.uint8) for each in (light, light[::-1]))
    dialog.show_pictures([path.name for path in question.paths])
    dialog.show_answer(CameraAnswer(question, pictures, make_measurement()))
    dialog.answer.more.click()
    gallery.compare(dialog, "camera")


PAGE = """\
# A page

A paragraph of some words,
with a [link](index.md).

```
code = of
two + lines
```

## A heading below

| one | two |
|---|---|
| 1 | 2.5 |

The last words.

![a picture](picture.png)
"""


def test_the_doors_look_as_stored(gallery: Gallery) -> None:
    dialog = gallery.show(WelcomeDialog())
    gallery.compare(dialog, "welcome")


def test_a_page_of_the_manual_looks_as_stored(gallery: Gallery, tmp_path: Path) -> None:
    (tmp_path / "index.md").write_text("* [A page](page.md): about it\n", encoding="utf-8")
    (tmp_path / "page.md").write_text(PAGE, encoding="utf-8")
    Image.new("RGB", (900, 60), (60, 120, 180)).save(tmp_path / "picture.png")
    manual = gallery.show(HelpWindow(tmp_path), 520, 470)
    manual.show_page("page.md")
    gallery.compare(manual, "manual")


def test_the_explanation_looks_as_stored(gallery: Gallery, snapshot_of: SnapshotOf) -> None:
    view = gallery.show(ExplanationView(), 400, 360)
    scene = snapshot_of().frame.scene
    view.equations.show_equations(equations(scene), frozenset())
    view.exposure.show_column(100, scene.camera.columns, True)
    view.exposure.show_window(exposure_window(scene, 100), 42.25)
    gallery.compare(view, "explanation")


def test_the_pane_of_a_photo_looks_as_stored(gallery: Gallery, photo: Photo) -> None:
    view = gallery.show(PhotoView(), 400, 420)
    view.show_photo(shown_photo(photo, Scene()))
    gallery.compare(view, "photo")
