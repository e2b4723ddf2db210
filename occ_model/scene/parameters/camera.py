"""Parameters of the camera, its lens and its sensor."""

from occ_model.scene.parameter_kinds import Count, Parameter, Quantity
from occ_model.scene.units import ELECTRON, METRE, NONE, PIXEL, SECOND

# fmt: off
CAMERA: tuple[Parameter, ...] = (
    Quantity(
        "exposure_time",
        "Exposure time",
        "t",
        "How long one column gathers light.",
        unit=SECOND, low=1e-9, high=1e6, slider=(1e-5, 2e-3), scale="log", default=136e-6,
    ),
    Quantity(
        "readout_time",
        "Readout time",
        "t_r",
        "Delay from one column's start to the next column's.",
        unit=SECOND, low=1e-9, high=10.0, slider=(1e-6, 1e-4), scale="log", default=8e-6,
    ),
    Quantity(
        "iso",
        "ISO speed",
        "S",
        "Gain of the camera.",
        unit=NONE, low=1.0, high=4e6, slider=(50.0, 6400.0), scale="log", default=100.0,
    ),
    Quantity(
        "f_number",
        "Aperture (f-number)",
        "N",
        "Focal length over the diameter of the aperture.",
        unit=NONE, low=0.5, high=128.0, slider=(1.0, 22.0), scale="log", default=2.48,
    ),
    Quantity(
        "gamma",
        "Gamma",
        "γ",  # noqa: RUF001 - the equation's own letter
        "Exponent of the camera's gamma encoding.",
        unit=NONE, low=1.0, high=4.0, slider=(1.0, 4.0), scale="linear", default=2.22,
    ),
    Quantity(
        "meter_constant",
        "Calibration constant",
        "K",
        "Calibration constant of the reflected-light meter.",
        unit=NONE, low=1.0, high=100.0, slider=(10.0, 15.0), scale="linear", default=12.5,
    ),
    Count("rows", "Rows", "", "Pixels of a column.", 1, 100_000, 4608),
    Count("columns", "Columns", "", "Columns read out, one after the other.", 1, 1_000_000, 3456),
    Quantity(
        "equivalent_focal_length",
        "Focal length (35 mm equivalent)",
        "",
        "Focal length of the lens that frames the same picture on a diagonal of 43.27 mm.",
        unit=METRE, low=1e-3, high=2.0, slider=(0.01, 0.2), scale="log", default=0.026,
    ),
    Count(
        "jpeg_quality",
        "JPEG quality",
        "",
        "Quality of the JPEG file that the camera writes, up to 100; 0: no JPEG.",
        0, 100, 0,
    ),
)

LENS: tuple[Parameter, ...] = (
    Quantity(
        "vignetting_exponent",
        "Vignetting exponent",
        "",
        "The light falls as cos^n of a pixel's angle off the optical axis: 4 by nature; 0: evenly.",
        unit=NONE, low=0.0, high=20.0, slider=(0.0, 8.0), scale="linear", default=0.0,
    ),
    Quantity(
        "radial_k1",
        "Radial distortion, first",
        "k_1",
        "Radial lens distortion: r (1 + k_1 r^2 + k_2 r^4), r in focal lengths.",
        unit=NONE, low=-10.0, high=10.0, slider=(-0.5, 0.5), scale="linear", default=0.0,
    ),
    Quantity(
        "radial_k2",
        "Radial distortion, second",
        "k_2",
        "Radial lens distortion of the fourth order.",
        unit=NONE, low=-10.0, high=10.0, slider=(-0.5, 0.5), scale="linear", default=0.0,
    ),
    Quantity(
        "tangential_p1",
        "Tangential distortion, first",
        "p_1",
        "Lens distortion by a lens that is off centre along the rows axis.",
        unit=NONE, low=-1.0, high=1.0, slider=(-0.02, 0.02), scale="linear", default=0.0,
    ),
    Quantity(
        "tangential_p2",
        "Tangential distortion, second",
        "p_2",
        "Lens distortion by a lens that is off centre along the columns axis.",
        unit=NONE, low=-1.0, high=1.0, slider=(-0.02, 0.02), scale="linear", default=0.0,
    ),
    Quantity(
        "point_spread",
        "Point spread of the lens",
        "",
        "Standard deviation of the spot that the lens makes of a point in focus; 0: a point.",
        unit=PIXEL, low=0.0, high=1000.0, slider=(0.0, 10.0), scale="linear", default=0.0,
    ),
    Quantity(
        "focus_distance",
        "Focus distance",
        "",
        "Distance at which the lens is sharp; 0: wherever the panel is.",
        unit=METRE, low=0.0, high=1e6, slider=(0.0, 3.0), scale="linear", default=0.0,
    ),
)

SENSOR: tuple[Parameter, ...] = (
    Quantity(
        "pixel_pitch",
        "Pixel pitch",
        "",
        "Distance from one pixel's centre to the next one's.",
        unit=METRE, low=1e-7, high=1e-4, slider=(0.5e-6, 10e-6), scale="log", default=1e-6,
    ),
    Quantity(
        "quantum_efficiency",
        "Quantum efficiency",
        "",
        "Electrons collected for each photon on the pixel, its colour filter included.",
        unit=NONE, low=1e-3, high=1.0, slider=(0.05, 1.0), scale="linear", default=0.55,
    ),
    Quantity(
        "full_well",
        "Full well",
        "",
        "Electrons that a pixel can hold.",
        unit=ELECTRON, low=10.0, high=1e9, slider=(1e3, 1e5), scale="log", default=4500.0,
    ),
    Quantity(
        "read_noise",
        "Read noise",
        "",
        "Standard deviation of the electrons read from a pixel that holds none.",
        unit=ELECTRON, low=0.0, high=1e4, slider=(0.0, 20.0), scale="linear", default=2.0,
    ),
    Quantity(
        "gain_variation",
        "Fixed-pattern gain (PRNU)",
        "",
        "Standard deviation of the gain from pixel to pixel, as a share; the same in all pictures.",
        unit=NONE, low=0.0, high=0.5, slider=(0.0, 0.05), scale="linear", default=0.008,
    ),
    Count(
        "adc_bits",
        "Converter bits",
        "",
        "Bits of the analogue-to-digital converter, before the gamma encoding.",
        4, 24, 10,
    ),
)
# fmt: on
