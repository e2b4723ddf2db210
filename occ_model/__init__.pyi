"""The public names, and the module of each: read by type checkers, and at run time."""

from .boards.sketch import transmitter_sketch as transmitter_sketch
from .camera.exposure import on_time as on_time
from .camera.photometry import column_profile as column_profile
from .camera.projection import panel_corners as panel_corners
from .effects.plan import plan as plan
from .errors import (
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
from .photo.camera.flash import measure_flash as measure_flash
from .photo.camera.measure import measure_camera as measure_camera
from .photo.chips.read import read_chips as read_chips
from .photo.comparison import compare as compare
from .photo.lamps.find import find_lamps as find_lamps
from .photo.lamps.match import match_lamps as match_lamps
from .photo.many.match_photos import match_photos as match_photos
from .photo.match import match_photo as match_photo
from .photo.reading.colours import (
    ColourPhoto as ColourPhoto,
    load_colours as load_colours,
)
from .photo.reading.load import (
    Photo as Photo,
    load_photo as load_photo,
)
from .photo.stripes.find import find_stripes as find_stripes
from .receiver.colour import (
    decode_colours as decode_colours,
    measure_mixing as measure_mixing,
)
from .receiver.decode import decode as decode, decoders as decoders
from .receiver.decoder import Decoder as Decoder, read_payload as read_payload
from .results.bands import (
    BandAdvice as BandAdvice,
    BandDepth as BandDepth,
    EyeFlicker as EyeFlicker,
)
from .results.bars_answer import BarsAnswer as BarsAnswer, UnlitRows as UnlitRows
from .results.bit_errors import BitErrors as BitErrors, MostBits as MostBits
from .results.camera import CameraMeasurement as CameraMeasurement
from .results.chip_reading import ChipReading as ChipReading
from .results.clock import Clock as Clock
from .results.colour import (
    ColourFrame as ColourFrame,
    ColourReading as ColourReading,
)
from .results.comparison import Comparison as Comparison
from .results.decoding import (
    DecodeResult as DecodeResult,
    Region as Region,
)
from .results.flash import FlashMeasurement as FlashMeasurement
from .results.frame import (
    Decision as Decision,
    Frame as Frame,
    Plan as Plan,
)
from .results.lamp import Lamp as Lamp
from .results.limits import Limits as Limits
from .results.match import (
    Alternative as Alternative,
    Match as Match,
    Stripes as Stripes,
)
from .results.photo_table import PhotoTable as PhotoTable
from .results.sent_packets import PacketReading as PacketReading
from .results.sweep import SweepTable as SweepTable
from .results.video import (
    Video as Video,
    VideoFrame as VideoFrame,
)
from .results.video_reading import (
    FilmProgress as FilmProgress,
    FrameReading as FrameReading,
    VideoReading as VideoReading,
)
from .room.locate import (
    RoomReading as RoomReading,
    read_room as read_room,
)
from .room.pose_fit import Located as Located
from .room.reading import ReadLamp as ReadLamp
from .room.render import (
    RoomFrame as RoomFrame,
    render_room as render_room,
)
from .room.room import (
    Place as Place,
    Room as Room,
    RoomLamp as RoomLamp,
)
from .room.rooms import (
    load_room as load_room,
    rooms as rooms,
)
from .scene.csk import csk_chromaticities as csk_chromaticities
from .scene.presets import (
    delete_preset as delete_preset,
    load_preset as load_preset,
    presets as presets,
    save_preset as save_preset,
)
from .scene.recording import (
    Recording as Recording,
    Waypoint as Waypoint,
)
from .scene.scene import Scene as Scene, SimulationSettings as SimulationSettings
from .simulation.band_model import (
    band_lengths as band_lengths,
    band_profile as band_profile,
)
from .simulation.colour import render_colour as render_colour
from .simulation.render import render as render
from .study.accuracy import accuracy as accuracy
from .study.bands.advice import band_advice as band_advice
from .study.bands.answer import bars_answer as bars_answer, unlit_rows as unlit_rows
from .study.bands.depth import band_depth as band_depth, pulse_depth as pulse_depth
from .study.bands.eye import eye_flicker as eye_flicker
from .study.bit_error_rate import bit_error_rate as bit_error_rate
from .study.confidence import wilson_interval as wilson_interval
from .study.limits import limits as limits
from .study.most_bits import most_bits as most_bits
from .study.success_rate import success_rate as success_rate
from .study.sweep.sweep import sweep as sweep
from .transmitter.framings.framing import (
    Framed as Framed,
    FrameFormat as FrameFormat,
    Framing as Framing,
)
from .transmitter.line_codes.line_code import (
    Decoded as Decoded,
    LineCode as LineCode,
)
from .transmitter.registry import (
    framings as framings,
    line_codes as line_codes,
)
from .transmitter.scheme import (
    Scheme as Scheme,
    packet as packet,
    scheme_of as scheme_of,
)
from .version import __version__ as __version__
from .video.colour import decode_colour_video as decode_colour_video
from .video.decode_film import decode_frames as decode_frames, decode_video as decode_video
from .video.file.write import write_video as write_video
from .video.load import load_video as load_video
from .video.reader import VideoReader as VideoReader
from .video.render import render_video as render_video
