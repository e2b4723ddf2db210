"""The paper's equations with the numbers of a scene."""

from occ_model.camera.photometry import WHITE, level_values, luminance_levels
from occ_model.errors import BandModelUndefined
from occ_model.results.teaching import Equation, Term
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, NIT, SECOND
from occ_model.simulation.band_model import band_lengths
from occ_model.study.theory import alternating_swing
from occ_model.teaching.quantities import COLUMN, result_text

_LIGHT = ("luminance", "illuminance", "reflectance")

_ON_TIME_PARAMETERS = (  # they determine how long the LED is on during a column's exposure
    "code", "bits", "payload", "line_code", "framing", "preamble", "error_correction", "pattern",
    "switching_frequency", "readout_time", "exposure_time", "start_time",
)  # fmt: skip

_MINUS = Term("−")  # noqa: RUF001 - a minus sign
_TIMES = Term("×")  # noqa: RUF001 - a multiplication sign
_EXPOSURE = Term("t", ("exposure_time",))
_PERIOD = Term("t<sub>LED</sub>", ("switching_frequency",))
_READOUT = Term("t<sub>r</sub>", ("readout_time",))


def equations(scene: Scene) -> tuple[Equation, ...]:
    """Return the equations that determine a scene's stripes, with its numbers.

    They are the paper's equations (1) to (3), the band lengths of the band model, the columns of a
    chip, the readout time of a picture, and the frequency at which an alternating pattern vanishes.
    """
    return (
        *_pixel_values(scene),
        _column_value(scene),
        *_band_lengths(scene),
        _chip_columns(scene),
        _frame_time(scene),
        _null(scene),
    )


def _terms(*parts: Term | str | tuple[str, str]) -> tuple[Term, ...]:
    """Make terms from signs, and from texts with the parameter on which each depends."""
    return tuple(
        part if isinstance(part, Term)
        else Term(part) if isinstance(part, str)
        else Term(part[0], (part[1],))
        for part in parts
    )  # fmt: skip


def _period_term(scene: Scene) -> Term:
    return Term(SECOND.format(scene.transmitter.switching_period), ("switching_frequency",))


def _value(scene: Scene, name: str) -> Term:
    return Term(PARAMETERS[name].format(scene.value(name)), (name,))  # type: ignore[arg-type]


def _pixel_values(scene: Scene) -> tuple[Equation, Equation]:
    dark, lit = luminance_levels(scene).tolist()
    low, high = level_values(scene).tolist()
    found = []
    for name, source, meaning, symbol, light, depends, value in (
        ("lit-panel", "(1)", "Pixel value of the lit panel, PV<sub>max</sub>",
         "L<sub>v</sub> + E<sub>v</sub>R/π", lit, _LIGHT, high),
        ("dark-panel", "(2)", "Pixel value of the dark panel, PV<sub>min</sub>",
         "E<sub>v</sub>R/π", dark, _LIGHT[1:], low),
    ):  # fmt: skip
        symbols = _terms(
            "118 (", ("S", "iso"), _EXPOSURE, Term(f"({symbol})", depends), "/ (",
            ("K", "meter_constant"), ("N<sup>2</sup>", "f_number"), ")",
            (")<sup>1/γ</sup>", "gamma"),  # noqa: RUF001 - the equation's own letter
        )  # fmt: skip
        numbers = _terms(
            "118 (", _value(scene, "iso"), _TIMES, _value(scene, "exposure_time"), _TIMES,
            Term(NIT.format(light, 4), depends), "/ (", _value(scene, "meter_constant"), _TIMES,
            (f"{scene.camera.f_number:g}<sup>2</sup>", "f_number"), ")",
            (f")<sup>1/{scene.camera.gamma:g}</sup>", "gamma"),
        )  # fmt: skip
        message = f"{value:.1f} grey levels"
        if value > WHITE:
            message += ", brighter than white"
        found.append(Equation(name, source, meaning, symbols, numbers, message))
    return found[0], found[1]


def _column_value(scene: Scene) -> Equation:
    low, high = level_values(scene).tolist()
    light = (*_LIGHT, "iso", "f_number", "gamma", "meter_constant", "exposure_time")
    on, off = (Term(f"t<sub>{state}</sub>", _ON_TIME_PARAMETERS) for state in ("on", "off"))
    symbols, numbers = (
        _terms("(", Term(lit, light), on, "+", Term(dark, light), off, ") /", exposure)
        for lit, dark, exposure in (
            ("PV<sub>max</sub>", "PV<sub>min</sub>", _EXPOSURE),
            (f"{high:.1f}", f"{low:.1f}", _value(scene, "exposure_time")),
        )
    )
    message = f"{min(low, WHITE):.1f} to {min(high, WHITE):.1f} grey levels, column by column"
    if scene.model.averaging == "light":
        message += "; here light is averaged, not pixel values"
    meaning = "Pixel value of a column, PV<sub>sim</sub>"
    return Equation("column", "(3)", meaning, symbols, numbers, message)


def _band_lengths(scene: Scene) -> tuple[Equation, Equation]:
    period = _period_term(scene)
    exposure, readout = (
        _value(scene, "exposure_time"),
        _value(scene, "readout_time"),
    )
    # Only the length of one state can be undefined; a transition always has a length.
    transition = result_text(COLUMN, scene.camera.exposure_time / scene.camera.readout_time)
    try:
        complete = result_text(COLUMN, band_lengths(scene)[0])
    except BandModelUndefined:
        complete = (
            "undefined: the exposure is longer than the switching period; the simulation goes on"
        )
    return (
        Equation(
            "one-state", "band model", "Columns of one state, h<sub>c</sub>",
            _terms("(", _PERIOD, _MINUS, _EXPOSURE, ") /", _READOUT),
            _terms("(", period, _MINUS, exposure, ") /", readout), complete,
        ),
        Equation(
            "transition", "band model", "Columns of a transition, h<sub>t</sub>",
            _terms(_EXPOSURE, "/", _READOUT), _terms(exposure, "/", readout), transition,
        ),
    )  # fmt: skip


def _chip_columns(scene: Scene) -> Equation:
    return Equation(
        "chip-columns", "readout", "Columns of a chip", _terms(_PERIOD, "/", _READOUT),
        _terms(_period_term(scene), "/", _value(scene, "readout_time")),
        result_text(COLUMN, scene.transmitter.switching_period / scene.camera.readout_time),
    )  # fmt: skip


def _frame_time(scene: Scene) -> Equation:
    camera = scene.camera
    return Equation(
        "frame-time", "readout", "Time to read out a whole picture",
        _terms(("columns", "columns"), _TIMES, _READOUT),
        _terms((f"{camera.columns} columns", "columns"), _TIMES, _value(scene, "readout_time")),
        result_text(SECOND, camera.columns * camera.readout_time),
    )  # fmt: skip


def _null(scene: Scene) -> Equation:
    exposure = scene.camera.exposure_time
    in_chips = exposure * scene.transmitter.switching_frequency
    contrast = alternating_swing(scene)
    return Equation(
        "null",
        "exposure",
        "Frequency at which an alternating pattern has no stripes",
        _terms("2 /", _EXPOSURE),
        _terms("2 /", _value(scene, "exposure_time")),
        f"{result_text(HERTZ, 2.0 / exposure)}; here, at {in_chips:.3g} chips an exposure, "
        f"{100.0 * contrast:.0f} % of its contrast is left",
    )
