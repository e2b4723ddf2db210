"""What the pane of the bars shows: the bars of a scene, and the answer about the user's lamp."""

from collections.abc import Mapping
from dataclasses import dataclass

from occ_model.results.bands import BandAdvice, BandDepth, DepthMap, EyeFlicker, RiskLines
from occ_model.results.bars_answer import BarsAnswer
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import band_advice
from occ_model.study.bands.answer import bars_answer
from occ_model.study.bands.depth import band_depth
from occ_model.study.bands.eye import eye_flicker, risk_lines
from occ_model.study.bands.least_depth import depth_map


@dataclass(frozen=True, eq=False, slots=True)
class SceneBars:
    """The bars of a scene, settings without bars, the map of the least depth, and the flicker."""

    scene: Scene
    depth: BandDepth
    advice: BandAdvice
    map: DepthMap
    eye: EyeFlicker
    lines: RiskLines


def compute_bars(scene: Scene) -> SceneBars:
    return SceneBars(
        scene, band_depth(scene), band_advice(scene), depth_map(scene), eye_flicker(scene),
        risk_lines(),
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class LampQuestion:
    """A lamp and a camera, as parameters of a scene."""

    light: Mapping[str, ParameterValue]
    exposure_time: float
    readout_time: float | None
    rows: int  # number of rows of a panel, lit in turn; 0 for other lamps

    def apply_to(self, scene: Scene) -> Scene:
        """Return a scene with this lamp and camera."""
        readout = {} if self.readout_time is None else {"readout_time": self.readout_time}
        return scene.replace(**self.light, exposure_time=self.exposure_time, **readout)


def answer_question(question: LampQuestion) -> BarsAnswer:
    scene = question.apply_to(Scene()).replace(illuminance=0.0)
    knows_readout = question.readout_time is not None
    return bars_answer(scene, knows_readout=knows_readout, rows=question.rows)
