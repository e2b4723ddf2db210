"""Parameters of the camera, its lens and its sensor."""

from dataclasses import dataclass

from occ_model.scene.parameters.group import (
    Group,
    count_field,
    quantity_field,
)
from occ_model.scene.units import ELECTRON, METRE, NONE, PIXEL, SECOND

DIAGONAL_35MM = 0.04327  # metres, of the 24 mm x 36 mm frame of equivalent focal lengths


@dataclass(frozen=True, kw_only=True)
class Camera(Group):
    # fmt: off
    exposure_time: float = quantity_field(
        "Exposure time", "t", "How long one column gathers light.",
        unit=SECOND, low=1e-9, high=1e6, slider=(1e-5, 2e-3), scale="log", default=136e-6,
    )
    readout_time: float = quantity_field(
        "Readout time", "t_r", "Delay from one column's start to the next column's.",
        unit=SECOND, low=1e-9, high=10.0, slider=(1e-6, 1e-4), scale="log", default=8e-6,
    )
    iso: float = quantity_field(
        "ISO speed", "S", "Gain of the camera.",
        unit=NONE, low=1.0, high=4e6, slider=(50.0, 6400.0), scale="log", default=100.0,
    )
    f_number: float = quantity_field(
        "Aperture (f-number)", "N", "Focal length over the diameter of the aperture.",
        unit=NONE, low=0.5, high=128.0, slider=(1.0, 22.0), scale="log", default=2.48,
    )
    gamma: float = quantity_field(
        "Gamma",
        "γ",  # noqa: RUF001 - the equation's own letter
        "Exponent of the camera's gamma encoding.",
        unit=NONE, low=1.0, high=4.0, slider=(1.0, 4.0), scale="linear", default=2.22,
    )
    meter_constant: float = quantity_field(
        "Calibration constant", "K", "Calibration constant of the reflected-light meter.",
        unit=NONE, low=1.0, high=100.0, slider=(10.0, 15.0), scale="linear", default=12.5,
    )
    rows: int = count_field("Rows", "", "Pixels of a column.", 1, 100_000, 4608)
    columns: int = count_field(
        "Columns", "", "Columns read out, one after the other.", 1, 1_000_000, 3456
    )
    equivalent_focal_length: float = quantity_field(
        "Focal length (35 mm equivalent)", "",
        "Focal length of the lens that frames the same picture on a diagonal of 43.27 mm.",
        unit=METRE, low=1e-3, high=2.0, slider=(0.01, 0.2), scale="log", default=0.026,
    )
    jpeg_quality: int = count_field(
        "JPEG quality", "",
        "Quality of the JPEG file that the camera writes, up to 100; 0: no JPEG.",
        0, 100, 0,
    )
    # fmt: on

    @property
    def focal_length_pixels(self) -> float:
        """Focal length in pixels, independent of a pixel's size."""
        diagonal: float = (self.rows**2 + self.columns**2) ** 0.5
        return self.equivalent_focal_length / DIAGONAL_35MM * diagonal


@dataclass(frozen=True, kw_only=True)
class Lens(Group):
    """The lens: vignetting, distortion, point spread and focus."""

    # fmt: off
    vignetting_exponent: float = quantity_field(
        "Vignetting exponent", "",
        "Light falls as cos^n of a pixel's angle to the optical axis; 4: a plain lens, 0: no fall.",
        unit=NONE, low=0.0, high=20.0, slider=(0.0, 8.0), scale="linear", default=0.0,
    )
    radial_k1: float = quantity_field(
        "Radial distortion, first", "k_1",
        "Radial lens distortion: r (1 + k_1 r^2 + k_2 r^4), r in focal lengths.",
        unit=NONE, low=-10.0, high=10.0, slider=(-0.5, 0.5), scale="linear", default=0.0,
    )
    radial_k2: float = quantity_field(
        "Radial distortion, second", "k_2", "Radial lens distortion of the fourth order.",
        unit=NONE, low=-10.0, high=10.0, slider=(-0.5, 0.5), scale="linear", default=0.0,
    )
    tangential_p1: float = quantity_field(
        "Tangential distortion, first", "p_1",
        "Lens distortion by a lens that is off centre along the rows axis.",
        unit=NONE, low=-1.0, high=1.0, slider=(-0.02, 0.02), scale="linear", default=0.0,
    )
    tangential_p2: float = quantity_field(
        "Tangential distortion, second", "p_2",
        "Lens distortion by a lens that is off centre along the columns axis.",
        unit=NONE, low=-1.0, high=1.0, slider=(-0.02, 0.02), scale="linear", default=0.0,
    )
    point_spread: float = quantity_field(
        "Point spread of the lens", "",
        "Standard deviation of the spot that the lens makes of a point in focus; 0: a point.",
        unit=PIXEL, low=0.0, high=1000.0, slider=(0.0, 10.0), scale="linear", default=0.0,
    )
    focus_distance: float = quantity_field(
        "Focus distance", "", "Distance at which the lens is sharp; 0: wherever the panel is.",
        unit=METRE, low=0.0, high=1e6, slider=(0.0, 3.0), scale="linear", default=0.0,
    )
    # fmt: on

    @property
    def distorts(self) -> bool:
        return any((self.radial_k1, self.radial_k2, self.tangential_p1, self.tangential_p2))


@dataclass(frozen=True, kw_only=True)
class Sensor(Group):
    """The sensor's pixels: size, efficiency, capacity, noise, converter."""

    # fmt: off
    pixel_pitch: float = quantity_field(
        "Pixel pitch", "", "Distance from one pixel's centre to the next one's.",
        unit=METRE, low=1e-7, high=1e-4, slider=(0.5e-6, 10e-6), scale="log", default=1e-6,
    )
    quantum_efficiency: float = quantity_field(
        "Quantum efficiency", "",
        "Electrons collected for each photon on the pixel, its colour filter included.",
        unit=NONE, low=1e-3, high=1.0, slider=(0.05, 1.0), scale="linear", default=0.55,
    )
    full_well: float = quantity_field(
        "Full well", "", "Electrons that a pixel can hold.",
        unit=ELECTRON, low=10.0, high=1e9, slider=(1e3, 1e5), scale="log", default=4500.0,
    )
    read_noise: float = quantity_field(
        "Read noise", "", "Standard deviation of the electrons read from a pixel that holds none.",
        unit=ELECTRON, low=0.0, high=1e4, slider=(0.0, 20.0), scale="linear", default=2.0,
    )
    gain_variation: float = quantity_field(
        "Fixed-pattern gain (PRNU)", "",
        "Standard deviation of the gain between pixels, as a fraction; the same in all pictures.",
        unit=NONE, low=0.0, high=0.5, slider=(0.0, 0.05), scale="linear", default=0.008,
    )
    adc_bits: int = count_field(
        "Converter bits", "",
        "Bits of the analogue-to-digital converter, before the gamma encoding.",
        4, 24, 10,
    )
    sensor_seed: int = count_field(
        "Sensor's number", "", "Which sensor of its kind: another one has other gains.",
        0, 2**31 - 1, 1,
    )
    # fmt: on
