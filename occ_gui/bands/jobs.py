"""All that the pane of the bars shows of a scene."""

from dataclasses import dataclass

from occ_model.results.bands import BandAdvice, BandDepth, DepthMap, EyeFlicker, RiskLines
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import band_advice
from occ_model.study.bands.depth import band_depth
from occ_model.study.bands.eye import eye_flicker, risk_lines
from occ_model.study.bands.least_depth import depth_map


@dataclass(frozen=True, eq=False, slots=True)
class SceneBars:
    """The bars of a scene, what shows none, the map of the least depth, and what the eye sees."""

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
