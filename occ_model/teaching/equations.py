"""The paper's equations with the numbers of a scene."""

from fractions import Fraction

import numpy as np

from occ_model.camera.photometry import (
    WHITE,
    ColumnLight,
    level_values,
    luminance_levels,
    panel_values,
)
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of, light_period
from occ_model.results.teaching import Equation, Term
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene, Transmitter
from occ_model.scene.units import HERTZ, NIT, SECOND
from occ_model.study.theory import alternating_swing
from occ_model.teaching.quantities import COLUMN, result_text

_LIGHT_PARAMETERS = ("luminance", "illuminance", "reflectance")

_LIT_PANELS = {"mains": "panel at its mean light"}

_MINUS = Term("−")  # noqa: RUF001 - a minus sign
_TIMES = Term("×")  # noqa: RUF001 - a multiplication sign
_EXPOSURE = Term("t", ("exposure_time",))
_READOUT = Term("t<sub>r</sub>", ("readout_time",))

_PERIODS = {  # of lights other than codes: the symbols, and the parameters they depend on
    "lamp": ("(1/F)", "lamp_frequency"),
    "mains": ("(1/2F)", "mains_frequency"),
    "waveform": ("(n t<sub>LED</sub>)", "levels", "switching_frequency"),
    "pulses": ("(1/F)", "pulse_frequency"),
}


def equations(scene: Scene) -> tuple[Equation, ...]:
    """Return the equations that determine a scene's stripes, with its numbers.

    They are the paper's equations (1) to (3), the band lengths of the band model where the light
    has states, the columns of a chip or of a light's period, the readout time of a picture, and
    where an alternating pattern, or the light, shows no stripes.
    """
    is_code = scene.transmitter.light == "code"
    return (
        *_pixel_values(scene),
        _column_value(scene),
        *_band_lengths(scene),
        _chip_columns(scene) if is_code else _period_columns(scene),
        _frame_time(scene),
        _null_frequency(scene) if is_code else _null_exposures(scene),
    )


def _terms(*parts: Term | str | tuple[str, str]) -> tuple[Term, ...]:
    """Make terms from signs, and from texts with the parameter on which each depends."""
    return tuple(
        part if isinstance(part, Term)
        else Term(part) if isinstance(part, str)
        else Term(part[0], (part[1],))
        for part in parts
    )  # fmt: skip


def _period(scene: Scene) -> tuple[Term, Term]:
    """Return the period of a light other than a code, in symbols and as a number."""
    symbols, *names = _PERIODS[scene.transmitter.light]
    if scene.transmitter.waveform_file:
        symbols, names = "T", ["waveform_file"]
    number = SECOND.format(float(light_period(scene.transmitter)))
    return Term(symbols, tuple(names)), Term(number, tuple(names))


def _shortest_state(scene: Scene) -> tuple[Term, float, str] | None:
    """Return the light's shortest lit state, in symbols and seconds, and its name; None if steady.

    It is a chip of a code, or the pulse of a blinking lamp.
    """
    transmitter = scene.transmitter
    lamp = None if transmitter.light == "code" else blinking_lamp(transmitter)
    if lamp is not None and 0.0 < lamp.duty < 1.0:
        symbols, *names = (
            ("D/F", "duty", "lamp_frequency")
            if transmitter.light == "lamp"
            else ("t<sub>flash</sub>", "pulse_length")
        )
        return Term(symbols, tuple(names)), lamp.duty / lamp.frequency, "pulse"
    if PARAMETERS["switching_frequency"].is_of(transmitter.light) and not transmitter.waveform_file:
        term = Term("t<sub>LED</sub>", ("switching_frequency",))
        return term, transmitter.switching_period, "switching period"
    return None


def _value(scene: Scene, name: str) -> Term:
    return Term(PARAMETERS[name].format(scene.value(name)), (name,))  # type: ignore[arg-type]


def _pixel_values(scene: Scene) -> tuple[Equation, Equation]:
    dark, lit = luminance_levels(scene).tolist()
    low, high = level_values(scene).tolist()
    kind, pixel_equations = scene.transmitter.light, []
    for name, source, meaning, symbol, light, dependencies, value in (
        ("lit-panel", "(1)",
         f"Pixel value of the {_LIT_PANELS.get(kind, 'lit panel')}, PV<sub>max</sub>",
         "L<sub>v</sub> + E<sub>v</sub>R/π", lit, _LIGHT_PARAMETERS, high),
        ("dark-panel", "(2)", "Pixel value of the dark panel, PV<sub>min</sub>",
         "E<sub>v</sub>R/π", dark, _LIGHT_PARAMETERS[1:], low),
    ):  # fmt: skip
        symbols = _terms(
            "118 (", ("S", "iso"), _EXPOSURE, Term(f"({symbol})", dependencies), "/ (",
            ("K", "meter_constant"), ("N<sup>2</sup>", "f_number"), ")",
            (")<sup>1/γ</sup>", "gamma"),  # noqa: RUF001 - the equation's own letter
        )  # fmt: skip
        numbers = _terms(
            "118 (", _value(scene, "iso"), _TIMES, _value(scene, "exposure_time"), _TIMES,
            Term(NIT.format(light, 4), dependencies),
            "/ (", _value(scene, "meter_constant"), _TIMES,
            (f"{scene.camera.f_number:g}<sup>2</sup>", "f_number"), ")",
            (f")<sup>1/{scene.camera.gamma:g}</sup>", "gamma"),
        )  # fmt: skip
        message = f"{value:.1f} grey levels"
        if value > WHITE:
            message += ", saturated"
        pixel_equations.append(Equation(name, source, meaning, symbols, numbers, message))
    return pixel_equations[0], pixel_equations[1]


def _column_value(scene: Scene) -> Equation:
    low, high = level_values(scene).tolist()
    light = (*_LIGHT_PARAMETERS, "iso", "f_number", "gamma", "meter_constant", "exposure_time")
    kind = scene.transmitter.light
    light_parameters = (
        name
        for name, declaration in Transmitter.declarations().items()
        if declaration.lights and declaration.is_of(kind)
    )
    time_parameters = (*light_parameters, "readout_time", "exposure_time", "start_time")
    lit_time, dark_time = (Term(f"t<sub>{state}</sub>", time_parameters) for state in ("on", "off"))
    symbols, numbers = (
        _terms("(", Term(lit, light), lit_time, "+", Term(dark, light), dark_time, ") /", exposure)
        for lit, dark, exposure in (
            ("PV<sub>max</sub>", "PV<sub>min</sub>", _EXPOSURE),
            (f"{high:.1f}", f"{low:.1f}", _value(scene, "exposure_time")),
        )
    )
    sent_light = light_of(scene.transmitter)
    if isinstance(sent_light, Cosine):  # its light exceeds its mean
        swing = sent_light.depth_in(Fraction(scene.camera.exposure_time)) * np.array([-1.0, 1.0])
        low, high = panel_values(scene, ColumnLight(1.0 + swing, np.ones(1))).tolist()
    message = f"{min(low, WHITE):.1f} to {min(high, WHITE):.1f} grey levels, column by column"
    if scene.model.averaging == "light":
        message += "; here light is averaged, not pixel values"
    meaning = "Pixel value of a column, PV<sub>sim</sub>"
    return Equation("column", "(3)", meaning, symbols, numbers, message)


def _band_lengths(scene: Scene) -> tuple[Equation, ...]:
    state = _shortest_state(scene)
    if state is None:
        return ()
    symbol, length, name = state
    camera = scene.camera
    exposure, readout = _value(scene, "exposure_time"), _value(scene, "readout_time")
    # Only the length of one state can be undefined; a transition always has a length.
    transition = result_text(COLUMN, camera.exposure_time / camera.readout_time)
    if camera.exposure_time <= length:
        one_state = result_text(COLUMN, (length - camera.exposure_time) / camera.readout_time)
    else:
        one_state = f"undefined: the exposure is longer than the {name}; the simulation goes on"
    lit = "fully lit" if name == "pulse" else "of one state"
    return (
        Equation(
            "one-state", "band model", f"Columns {lit}, h<sub>c</sub>",
            _terms("(", symbol, _MINUS, _EXPOSURE, ") /", _READOUT),
            _terms(
                "(", Term(SECOND.format(length), symbol.parameters), _MINUS, exposure, ") /",
                readout,
            ), one_state,
        ),
        Equation(
            "transition", "band model", "Columns of a transition, h<sub>t</sub>",
            _terms(_EXPOSURE, "/", _READOUT), _terms(exposure, "/", readout), transition,
        ),
    )  # fmt: skip


def _chip_columns(scene: Scene) -> Equation:
    period = scene.transmitter.switching_period
    named = ("switching_frequency",)
    return _columns_equation(
        scene, "a chip", Term("t<sub>LED</sub>", named), Term(SECOND.format(period), named), period
    )


def _period_columns(scene: Scene) -> Equation:
    """Return the columns from bar to bar, under the name that lessons use for those of a chip."""
    return _columns_equation(
        scene, "the light's period", *_period(scene), float(light_period(scene.transmitter))
    )


def _columns_equation(
    scene: Scene, noun: str, symbol: Term, number: Term, seconds: float
) -> Equation:
    return Equation(
        "chip-columns", "readout", f"Columns of {noun}", _terms(symbol, "/", _READOUT),
        _terms(number, "/", _value(scene, "readout_time")),
        result_text(COLUMN, seconds / scene.camera.readout_time),
    )  # fmt: skip


def _frame_time(scene: Scene) -> Equation:
    camera = scene.camera
    return Equation(
        "frame-time", "readout", "Time to read out a whole picture",
        _terms(("columns", "columns"), _TIMES, _READOUT),
        _terms((f"{camera.columns} columns", "columns"), _TIMES, _value(scene, "readout_time")),
        result_text(SECOND, camera.columns * camera.readout_time),
    )  # fmt: skip


def _null_frequency(scene: Scene) -> Equation:
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


def _null_exposures(scene: Scene) -> Equation:
    """Return the exposures of whole periods, and the number of periods in the present one."""
    symbol, number = _period(scene)
    periods = scene.camera.exposure_time / float(light_period(scene.transmitter))
    return Equation(
        "null", "exposure", "Exposures at which the light makes no bars",
        _terms("k", _TIMES, symbol), _terms("k", _TIMES, number),
        f"k = 1, 2, 3 and so on; here t / period = {periods:.3g}",
    )  # fmt: skip
