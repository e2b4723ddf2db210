"""A user's settings for their own figures do not affect the figures of this package."""

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from occ_model.figures.drawing import figure_bytes, house_style
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene


def draw() -> bytes:
    with house_style():
        figure = Figure()  # without axes, which take as long to place as all else does
        figure.text(0.5, 0.5, "Grey level")
        figure.add_artist(Line2D([0.0, 1.0], [0.0, 1.0]))
        provenance = Provenance("A line", {"at hand": Scene()}, 1, (), "2026-01-01")
        return figure_bytes(figure, "svg", provenance)


def test_figures_ignore_and_keep_settings_of_the_same_process() -> None:
    before = draw()
    with mpl.rc_context({"lines.linewidth": 9, "figure.facecolor": "red"}):
        assert draw() == before
        assert mpl.rcParams["lines.linewidth"] == 9
