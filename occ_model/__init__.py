"""A model of optical camera communication: a blinking panel, a rolling shutter, a receiver.

Everything here works without a window. A scene is a value; the functions take it and give arrays::

    import occ_model as occ

    scene = occ.load_preset("phone-136us").replace(switching_frequency=10e3, distance=1.2)
    frame = occ.render(scene)
    result = occ.decode(frame.image, scene)
"""

from occ_model.version import __version__

TYPE_CHECKING = False  # as typing has it, which is slow to import
if TYPE_CHECKING:
    from occ_model.camera.exposure import on_time
    from occ_model.camera.photometry import column_profile
    from occ_model.camera.projection import panel_corners
    from occ_model.effects.plan import plan
    from occ_model.errors import (
        BandModelUndefined,
        DecodeInputError,
        MatchError,
        OccError,
        OutputError,
        ParameterError,
        PhotoError,
        PresetError,
        ProjectionError,
        SceneFileError,
    )
    from occ_model.photo.comparison import compare
    from occ_model.photo.match import match_photo
    from occ_model.photo.reading.load import Photo, load_photo
    from occ_model.photo.stripes.find import find_stripes
    from occ_model.receiver.decode import decode
    from occ_model.results import (
        Comparison,
        Decision,
        DecodeResult,
        Frame,
        Limits,
        Match,
        Plan,
        Region,
        Stripes,
        SweepTable,
    )
    from occ_model.scene.presets import delete_preset, load_preset, presets, save_preset
    from occ_model.scene.scene import Scene
    from occ_model.scene.simulation_settings import SimulationSettings
    from occ_model.simulation.band_model import band_lengths, band_profile
    from occ_model.simulation.render import render
    from occ_model.study.accuracy import accuracy
    from occ_model.study.confidence import wilson_interval
    from occ_model.study.limits import limits
    from occ_model.study.success_rate import success_rate
    from occ_model.study.sweep.sweep import sweep
    from occ_model.transmitter.packet import packet

__all__ = [
    "BandModelUndefined",
    "Comparison",
    "Decision",
    "DecodeInputError",
    "DecodeResult",
    "Frame",
    "Limits",
    "Match",
    "MatchError",
    "OccError",
    "OutputError",
    "ParameterError",
    "Photo",
    "PhotoError",
    "Plan",
    "PresetError",
    "ProjectionError",
    "Region",
    "Scene",
    "SceneFileError",
    "SimulationSettings",
    "Stripes",
    "SweepTable",
    "__version__",
    "accuracy",
    "band_lengths",
    "band_profile",
    "column_profile",
    "compare",
    "decode",
    "delete_preset",
    "find_stripes",
    "limits",
    "load_photo",
    "load_preset",
    "match_photo",
    "on_time",
    "packet",
    "panel_corners",
    "plan",
    "presets",
    "render",
    "save_preset",
    "success_rate",
    "sweep",
    "wilson_interval",
]

_MODULES = {
    "BandModelUndefined": "errors",
    "Comparison": "results",
    "Decision": "results",
    "DecodeInputError": "errors",
    "DecodeResult": "results",
    "Frame": "results",
    "Limits": "results",
    "Match": "results",
    "MatchError": "errors",
    "OccError": "errors",
    "OutputError": "errors",
    "ParameterError": "errors",
    "Photo": "photo.reading.load",
    "PhotoError": "errors",
    "Plan": "results",
    "PresetError": "errors",
    "ProjectionError": "errors",
    "Region": "results",
    "Scene": "scene.scene",
    "SceneFileError": "errors",
    "SimulationSettings": "scene.simulation_settings",
    "Stripes": "results",
    "SweepTable": "results",
    "accuracy": "study.accuracy",
    "band_lengths": "simulation.band_model",
    "band_profile": "simulation.band_model",
    "column_profile": "camera.photometry",
    "compare": "photo.comparison",
    "decode": "receiver.decode",
    "delete_preset": "scene.presets",
    "find_stripes": "photo.stripes.find",
    "limits": "study.limits",
    "load_photo": "photo.reading.load",
    "load_preset": "scene.presets",
    "match_photo": "photo.match",
    "on_time": "camera.exposure",
    "packet": "transmitter.packet",
    "panel_corners": "camera.projection",
    "plan": "effects.plan",
    "presets": "scene.presets",
    "render": "simulation.render",
    "save_preset": "scene.presets",
    "success_rate": "study.success_rate",
    "sweep": "study.sweep.sweep",
    "wilson_interval": "study.confidence",
}
"""Where each name is: it is imported when it is first asked for, so that a program can answer
Ctrl-C, ``--help`` and its workers before numpy is there."""


def __getattr__(name: str) -> object:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value: object = getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
