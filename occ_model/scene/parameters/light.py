"""Parameters of the light: the transmitter's and the surroundings'."""

import math
from dataclasses import dataclass

from occ_model import plugins
from occ_model.errors import ParameterError, inflect
from occ_model.scene.light_samples import LEVELS, SAMPLES, canonical_file, canonical_levels
from occ_model.scene.parameters.group import (
    Group,
    choice_field,
    count_field,
    open_choice_field,
    pattern_field,
    payload_field,
    quantity_field,
    text_field,
)
from occ_model.scene.payload import bits_of_payload
from occ_model.scene.units import HERTZ, LUX, METRE, NIT, NONE, PERCENT, RADIAN, SECOND

LIGHTS = ("code", "lamp", "mains", "waveform", "pulses")

_CODE, _LAMP, _MAINS, _WAVEFORM, _PULSES = ((light,) for light in LIGHTS)

MAX_BITS = 16

MAX_PREAMBLE_CHIPS = 64


@dataclass(frozen=True, kw_only=True)
class Transmitter(Group):
    # fmt: off
    light: str = choice_field(
        "Light", "",
        "A code, a dimmed lamp, a lamp on the mains, a waveform of any levels, or short flashes.",
        LIGHTS, "code",
    )
    lamp_frequency: float = quantity_field(
        "Lamp frequency", "F", "Cycles per second of a blinking lamp.",
        unit=HERTZ, low=0.01, high=1e9, slider=(50.0, 20e3), scale="log", default=1000.0,
        lights=_LAMP,
    )
    duty: float = quantity_field(
        "Duty cycle", "D", "Fraction of each cycle in which the lamp is lit, from its start on.",
        unit=PERCENT, low=0.0, high=1.0, slider=(0.0, 1.0), scale="linear", default=0.5,
        lights=_LAMP,
    )
    depth: float = quantity_field(
        "Lamp's depth", "",
        "Light that the lamp loses between its pulses, as a fraction; 100 %: it is dark there.",
        unit=PERCENT, low=0.0, high=1.0, slider=(0.0, 1.0), scale="linear", default=1.0,
        lights=_LAMP,
    )
    mains_frequency: float = quantity_field(
        "Mains frequency", "", "Frequency of the mains; a lamp's light swings at twice that.",
        unit=HERTZ, low=1.0, high=1000.0, slider=(45.0, 65.0), scale="linear", default=50.0,
        lights=_MAINS,
    )
    mains_depth: float = quantity_field(
        "Mains depth", "",
        "Amplitude of the light's swing as a fraction of its mean: 1 + m cos(4 pi F x), also of "
        "the surroundings.",
        unit=PERCENT, low=0.0, high=1.0, slider=(0.0, 1.0), scale="linear", default=0.3,
        lights=_MAINS,
    )
    levels: str = text_field(
        "Levels", "", "Levels of light sent over and over, one each switching period.",
        "0 1 2 3 / 3", LEVELS, canonical_levels, lights=_WAVEFORM,
    )
    waveform_file: str = text_field(
        "Recorded waveform", "",
        "Seconds and levels of light, sent over and over in place of the levels above.",
        "", SAMPLES, canonical_file, empty="the levels", lights=_WAVEFORM,
    )
    pulse_frequency: float = quantity_field(
        "Flash frequency", "", "Flashes per second.",
        unit=HERTZ, low=0.01, high=1e9, slider=(1.0, 1e3), scale="log", default=60.0,
        lights=_PULSES,
    )
    pulse_length: float = quantity_field(
        "Flash length", "", "How long a flash lasts; steady light where the next one has begun.",
        unit=SECOND, low=1e-9, high=100.0, slider=(1e-5, 1e-2), scale="log", default=500e-6,
        lights=_PULSES,
    )
    code: int = count_field(
        "Code", "", "The number sent, from 0 to 2^bits - 1.", 0, 2**MAX_BITS - 1, 718,
        lights=_CODE,
    )
    bits: int = count_field(
        "Bits", "", "How many bits the code has.", 2, MAX_BITS, 10, lights=_CODE
    )
    payload: str = payload_field(
        "Payload", "", "Text, bytes or bits that are sent in place of the code; empty: the code.",
        "", lights=_CODE,
    )
    line_code: str = open_choice_field(
        "Line code", "", "The rule that turns bits into chips.",
        ("differential-manchester", "manchester", "nrz", "4b6b", "8b10b", "fsk"),
        "differential-manchester",
        group=plugins.LINE_CODES, lights=_CODE,
    )
    framing: str = open_choice_field(
        "Framing", "",
        "How the chips show where a payload starts, and whether it was read correctly.",
        ("paper", "preamble", "c-ook", "raw"), "paper", group=plugins.FRAMINGS,
        lights=_CODE,
    )
    preamble: str = pattern_field(
        "Preamble", "",
        "Chips that start a frame of the framings preamble and raw; empty: the line code's own.",
        "", most=MAX_PREAMBLE_CHIPS, empty="the line code's own", lights=_CODE,
    )
    error_correction: str = choice_field(
        "Error correction", "", "Bytes added to the payload, which let wrong ones be corrected.",
        ("none", "reed-solomon"), "none", lights=_CODE,
    )
    pattern: str = pattern_field(
        "Raw chip pattern", "", "Chips sent over and over in place of packets; empty: packets.",
        "", lights=_CODE,
    )
    switching_frequency: float = quantity_field(
        "Switching frequency", "f",
        "Chips or levels sent per second; one lasts the switching period t_LED = 1/f.",
        unit=HERTZ, low=1.0, high=1e9, slider=(500.0, 100e3), scale="log", default=10e3,
        lights=_CODE + _WAVEFORM,
    )
    luminance: float = quantity_field(
        "Luminance", "L_v", "Luminance of the lit panel.",
        unit=NIT, low=0.0, high=1e16, slider=(10.0, 1e5), scale="log", default=3600.0,
    )
    panel_width: float = quantity_field(
        "Panel width", "", "Size of the panel along the image's columns axis.",
        unit=METRE, low=1e-4, high=100.0, slider=(0.01, 2.0), scale="log", default=0.6,
    )
    panel_height: float = quantity_field(
        "Panel height", "", "Size of the panel along the image's rows axis.",
        unit=METRE, low=1e-4, high=100.0, slider=(0.01, 2.0), scale="log", default=0.6,
    )
    edge_time: float = quantity_field(
        "LED rise and fall time", "",
        "Time that the LED takes from dark to lit and from lit to dark; 0: none.",
        unit=SECOND, low=0.0, high=1.0, slider=(0.0, 50e-6), scale="linear", default=0.0,
    )
    lambertian_order: float = quantity_field(
        "Lambertian order", "m",
        "The panel's intensity falls as cos^m of the angle; 1: equally bright from all sides.",
        unit=NONE, low=1.0, high=100.0, slider=(1.0, 10.0), scale="linear", default=1.0,
    )
    # fmt: on

    def _check_together(self) -> None:
        if self.code >= 2**self.bits:
            raise ParameterError.of(
                "code",
                f"{self.code}",
                f"0 to {2**self.bits - 1}",
                condition=f"with {inflect(self.bits, 'bit')}",
                parameters=("code", "bits"),
            )

    @property
    def payload_bits(self) -> tuple[int, ...]:
        """The bits in the order sent: the payload's if there is one, else the code's."""
        if self.payload:
            return bits_of_payload(self.payload)
        return tuple(self.code >> place & 1 for place in reversed(range(self.bits)))

    @property
    def payload_length(self) -> int:
        return len(self.payload_bits) if self.payload else self.bits

    @property
    def switching_period(self) -> float:
        """Length of one chip, t_LED = 1/f, in seconds."""
        return 1.0 / self.switching_frequency


@dataclass(frozen=True, kw_only=True)
class Surroundings(Group):
    """The light that does not come from the panel, and its flicker."""

    # fmt: off
    illuminance: float = quantity_field(
        "External illuminance", "E_v", "Light that falls on the panel from elsewhere.",
        unit=LUX, low=0.0, high=1e16, slider=(1.0, 1e5), scale="log", default=290.0,
    )
    reflectance: float = quantity_field(
        "Reflectance", "R", "Fraction of that light which the panel and its surroundings reflect.",
        unit=NONE, low=0.0, high=1.0, slider=(0.0, 1.0), scale="linear", default=0.4,
    )
    flicker_depth: float = quantity_field(
        "Flicker depth", "",
        "Amplitude of the ambient light's flicker, as a fraction of its mean; 0: steady.",
        unit=NONE, low=0.0, high=1.0, slider=(0.0, 1.0), scale="linear", default=0.0,
    )
    flicker_frequency: float = quantity_field(
        "Flicker frequency", "", "Frequency of the flicker: twice that of the mains.",
        unit=HERTZ, low=0.01, high=1e9, slider=(50.0, 1000.0), scale="log", default=100.0,
    )
    flicker_phase: float = quantity_field(
        "Flicker phase", "", "Phase of the flicker at time zero; 0: at its maximum.",
        unit=RADIAN, low=-math.pi, high=math.pi,
        slider=(-math.pi, math.pi), scale="linear", default=0.0,
    )
    # fmt: on
