"""A model of optical camera communication: a blinking panel, a rolling shutter, a receiver.

Everything here works without a window. A scene is a value; the functions take it and give arrays::

    import occ_model as occ

    scene = occ.load_preset("phone-136us").replace(switching_frequency=10e3, distance=1.2)
    frame = occ.render(scene)
    result = occ.decode(frame.image, scene)
"""

import builtins
from types import SimpleNamespace

from occ_model.version import __version__ as __version__

TYPE_CHECKING = False  # that of typing, which is slow to import

_MODULES: dict[str, str] = {}
"""The module of each public name, imported at the first use: Ctrl-C and ``--help`` need no
numpy."""

_import = builtins.__import__


def _note(name: str, *rest: object, **named: object) -> object:
    """Note which names this module imports below, and from where, in place of importing them."""
    if not rest or rest[0] is not globals():  # another thread imports meanwhile
        return _import(name, *rest, **named)  # type: ignore[arg-type]
    _space, _local, names, _level = rest
    noted = dict.fromkeys(names, name)  # type: ignore[call-overload]
    _MODULES.update(noted)
    return SimpleNamespace(**noted)


# isort: off
builtins.__import__ = _note  # type: ignore[assignment]
try:  # type checkers and editors take these statements as they are
    from occ_model.boards.sketch import transmitter_sketch as transmitter_sketch
    from occ_model.camera.exposure import on_time as on_time
    from occ_model.camera.photometry import column_profile as column_profile
    from occ_model.camera.projection import panel_corners as panel_corners
    from occ_model.effects.plan import plan as plan
    from occ_model.errors import (
        BandModelUndefined as BandModelUndefined,
        DecodeInputError as DecodeInputError,
        MatchError as MatchError,
        OccError as OccError,
        OutputError as OutputError,
        ParameterError as ParameterError,
        PhotoError as PhotoError,
        PluginError as PluginError,
        PresetError as PresetError,
        ProjectionError as ProjectionError,
        SceneFileError as SceneFileError,
        VideoError as VideoError,
    )
    from occ_model.photo.chips.read import read_chips as read_chips
    from occ_model.photo.comparison import compare as compare
    from occ_model.photo.lamps.find import find_lamps as find_lamps
    from occ_model.photo.lamps.match import match_lamps as match_lamps
    from occ_model.photo.many.match_photos import match_photos as match_photos
    from occ_model.photo.match import match_photo as match_photo
    from occ_model.photo.reading.load import (
        Photo as Photo,
        load_photo as load_photo,
    )
    from occ_model.photo.stripes.find import find_stripes as find_stripes
    from occ_model.receiver.decode import decode as decode
    from occ_model.receiver.decoder import Decoder as Decoder
    from occ_model.receiver.decoders import decoders as decoders
    from occ_model.receiver.decoder import read_payload as read_payload
    from occ_model.results.bands import (
        BandAdvice as BandAdvice,
        BandDepth as BandDepth,
        EyeFlicker as EyeFlicker,
    )
    from occ_model.results.bit_errors import BitErrors as BitErrors
    from occ_model.results.decoding import (
        DecodeResult as DecodeResult,
        Region as Region,
    )
    from occ_model.results.frame import Frame as Frame
    from occ_model.results.lamp import Lamp as Lamp
    from occ_model.results.limits import Limits as Limits
    from occ_model.results.match import (
        Alternative as Alternative,
        ChipReading as ChipReading,
        Comparison as Comparison,
        Match as Match,
        Stripes as Stripes,
    )
    from occ_model.results.bit_errors import MostBits as MostBits
    from occ_model.results.photo_table import PhotoTable as PhotoTable
    from occ_model.results.plan import (
        Decision as Decision,
        Plan as Plan,
    )
    from occ_model.results.sent_packets import PacketReading as PacketReading
    from occ_model.results.sweep import SweepTable as SweepTable
    from occ_model.results.video import (
        Video as Video,
        VideoFrame as VideoFrame,
    )
    from occ_model.results.video_reading import (
        Clock as Clock,
        FilmProgress as FilmProgress,
        FrameReading as FrameReading,
        VideoReading as VideoReading,
    )
    from occ_model.room.locate import (
        RoomReading as RoomReading,
        read_room as read_room,
    )
    from occ_model.room.pose_fit import Located as Located
    from occ_model.room.reading import ReadLamp as ReadLamp
    from occ_model.room.render import (
        RoomFrame as RoomFrame,
        render_room as render_room,
    )
    from occ_model.room.room import (
        Place as Place,
        Room as Room,
        RoomLamp as RoomLamp,
    )
    from occ_model.room.rooms import (
        load_room as load_room,
        rooms as rooms,
    )
    from occ_model.scene.presets import (
        delete_preset as delete_preset,
        load_preset as load_preset,
        presets as presets,
        save_preset as save_preset,
    )
    from occ_model.scene.recording import (
        Recording as Recording,
        Waypoint as Waypoint,
    )
    from occ_model.scene.scene import Scene as Scene
    from occ_model.scene.simulation_settings import SimulationSettings as SimulationSettings
    from occ_model.simulation.band_model import (
        band_lengths as band_lengths,
        band_profile as band_profile,
    )
    from occ_model.simulation.render import render as render
    from occ_model.study.accuracy import accuracy as accuracy
    from occ_model.study.bands.advice import band_advice as band_advice
    from occ_model.study.bands.depth import band_depth as band_depth
    from occ_model.study.bands.eye import eye_flicker as eye_flicker
    from occ_model.study.bands.depth import pulse_depth as pulse_depth
    from occ_model.study.bit_error_rate import bit_error_rate as bit_error_rate
    from occ_model.study.confidence import wilson_interval as wilson_interval
    from occ_model.study.limits import limits as limits
    from occ_model.study.most_bits import most_bits as most_bits
    from occ_model.study.success_rate import success_rate as success_rate
    from occ_model.study.sweep.sweep import sweep as sweep
    from occ_model.transmitter.framings.framing import (
        Framed as Framed,
        FrameFormat as FrameFormat,
        Framing as Framing,
    )
    from occ_model.transmitter.line_codes.line_code import (
        Decoded as Decoded,
        LineCode as LineCode,
    )
    from occ_model.transmitter.packet import packet as packet
    from occ_model.transmitter.registry import (
        framings as framings,
        line_codes as line_codes,
    )
    from occ_model.transmitter.scheme import (
        Scheme as Scheme,
        scheme_of as scheme_of,
    )
    from occ_model.video.file.write import write_video as write_video
    from occ_model.video.load import load_video as load_video
    from occ_model.video.reader import (
        VideoReader as VideoReader,
        decode_frames as decode_frames,
        decode_video as decode_video,
    )
    from occ_model.video.render import render_video as render_video
finally:
    builtins.__import__ = _import
# isort: on
if not TYPE_CHECKING:  # type checkers need none of these, and would take any name for public
    for _name in _MODULES:
        del globals()[_name]

    __all__ = sorted(["__version__", *_MODULES])

    def __getattr__(name: str) -> object:
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        value = getattr(_import(_MODULES[name], fromlist=[name]), name)
        if type(value) is type(__getattr__):  # a function
            from occ_model.argument_kinds import checked

            value = checked(value)
        globals()[name] = value
        return value

    def __dir__() -> set[str]:
        return {*globals(), *__all__}
