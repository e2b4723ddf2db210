"""Result types of the model: pictures, plans, decodings, matches, studies."""

from occ_model.results.accuracy import (
    ACCURACY_PARTS,
    CHAINED_PARTS,
    CLOSED_FORM,
    LEAST_ERROR,
    AccuracyPoint,
)
from occ_model.results.bands import BandAdvice, BandDepth, Depth, EyeFlicker, SpeedDepth
from occ_model.results.bit_errors import BitErrors
from occ_model.results.decoding import DecodeResult, Location, Region, RunHistogram, Runs
from occ_model.results.effect_costs import (
    EffectCrop,
    EffectDifference,
    Forecast,
    MeasuredCosts,
    TimeShares,
)
from occ_model.results.frame import Frame
from occ_model.results.lamp import Lamp
from occ_model.results.limits import Limits, RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.match import Alternative, ChipReading, Comparison, Match, Stripes
from occ_model.results.most_bits import MostBits
from occ_model.results.photo_table import CombinedEstimate, PhotoRow, PhotoTable
from occ_model.results.plan import Decision, Plan, Way
from occ_model.results.sent_packets import PacketReading, SentPackets
from occ_model.results.sweep import SweepRow, SweepTable
from occ_model.results.sweep_request import RateSettings, SignalPath, SweepPoint, SweepRequest
from occ_model.results.video import Video, VideoFrame
from occ_model.results.video_reading import (
    Clock,
    FilmProgress,
    FrameReading,
    Measured,
    RateWindow,
    VideoReading,
)

__all__ = [
    "ACCURACY_PARTS",
    "CHAINED_PARTS",
    "CLOSED_FORM",
    "LEAST_ERROR",
    "AccuracyPoint",
    "Alternative",
    "BandAdvice",
    "BandDepth",
    "BitErrors",
    "ChipReading",
    "Clock",
    "CombinedEstimate",
    "Comparison",
    "Decision",
    "DecodeResult",
    "Depth",
    "EffectCrop",
    "EffectDifference",
    "EyeFlicker",
    "FilmProgress",
    "Forecast",
    "Frame",
    "FrameReading",
    "Lamp",
    "Limits",
    "Location",
    "Match",
    "Measured",
    "MeasuredCosts",
    "MostBits",
    "PacketReading",
    "PhotoRow",
    "PhotoTable",
    "Plan",
    "RangeEnd",
    "RateSettings",
    "RateWindow",
    "ReadInterval",
    "Region",
    "RunHistogram",
    "Runs",
    "SentPackets",
    "SignalPath",
    "SpeedDepth",
    "Stripes",
    "SweepPoint",
    "SweepRequest",
    "SweepRow",
    "SweepTable",
    "TimeShares",
    "Trial",
    "Video",
    "VideoFrame",
    "VideoReading",
    "Way",
    "WorkingRange",
]
