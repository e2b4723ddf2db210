"""Comparison of two pinned scenes: what they differ in, and what becomes of it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from occ_gui.scene.forced_effects import describe_forced
from occ_gui.scene.parameter_rows import explain
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.simulation.verdict import cause_in, is_right, reason_in
from occ_gui.values.simulated import SimulationRequest
from occ_model.arrays import FloatArray
from occ_model.errors import one_line
from occ_model.results.bands import depth_text
from occ_model.results.decoding import PAPER_DECODER, DecodeResult
from occ_model.scene.light_words import has_chips
from occ_model.scene.parameter_kinds import Parameter, ParameterValue, format_distinctly
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, TOLERANCE, Scene, SimulationSettings


@dataclass(frozen=True, eq=False, slots=True)
class Pin:
    request: SimulationRequest
    profile: FloatArray  # shape (columns,), in grey levels
    # The first column of the panel, and the columns of one period of the signal sent
    first_column: float
    period_columns: float
    outputs: tuple[tuple[str, str, str], ...]  # the name, text and meaning of each

    @property
    def scene(self) -> Scene:
        return self.request.scene

    @property
    def settings(self) -> SimulationSettings:
        return self.request.settings


@dataclass(frozen=True, slots=True)
class DifferenceRow:
    name: str
    a: str
    b: str
    meaning: str


@dataclass(frozen=True, eq=False, slots=True)
class PinnedPair:
    a: Pin | None = None
    b: Pin | None = None
    inputs: tuple[DifferenceRow, ...] = ()
    outputs: tuple[DifferenceRow, ...] = ()


_LONGEST_PAYLOAD = 24  # characters of a payload that the table shows


def compare_pins(a: Pin | None, b: Pin | None, labels: Mapping[str, str]) -> PinnedPair:
    """Compare two pins, if there are two; ``labels``: the labels of effects, by their names."""
    if a is None or b is None:
        return PinnedPair(a, b)
    inputs, outputs = _compare_inputs(a, b, labels), _compare_outputs(a, b)
    return PinnedPair(a, b, tuple(inputs), tuple(outputs))


def _compare_inputs(a: Pin, b: Pin, labels: Mapping[str, str]) -> list[DifferenceRow]:
    names = (name for names in GROUPS.values() for name in names)
    inputs: list[tuple[Parameter, ParameterValue, ParameterValue]] = [
        (PARAMETERS[name], a.scene.value(name), b.scene.value(name)) for name in names
    ]
    inputs.append((TOLERANCE, a.settings.tolerance, b.settings.tolerance))
    rows = []
    for parameter, value_a, value_b in inputs:
        if value_a != value_b:
            texts = format_distinctly(parameter, value_a, value_b)
            first, second = (text or "none" for text in texts)
            rows.append(DifferenceRow(parameter.label, first, second, explain(parameter)))
    if a.settings.force != b.settings.force:
        forced = (describe_forced(pin.settings.force, labels) for pin in (a, b))
        first, second = (text or "none" for text in forced)
        meaning = "Effects that you have switched on or off; the plan decides about the others."
        rows.append(DifferenceRow("Effects switched", first, second, meaning))
    return rows


def _compare_outputs(a: Pin, b: Pin) -> Iterator[DifferenceRow]:
    """Compare outputs by name; slow decoders and plug-ins have one only if they were chosen."""
    texts = [{name: text for name, text, _ in pin.outputs} for pin in (a, b)]
    meanings = {name: meaning for name, _, meaning in (*a.outputs, *b.outputs)}
    for name, meaning in meanings.items():
        text_a, text_b = (texts_of_pin.get(name, "not read") for texts_of_pin in texts)
        if text_a != text_b:
            yield DifferenceRow(name, text_a, text_b, meaning)


def make_pin(snapshot: Snapshot) -> Pin:
    frame = snapshot.frame
    return Pin(
        request=snapshot.request,
        profile=frame.profile,
        first_column=snapshot.panel_origin[0],
        period_columns=snapshot.period_columns,
        outputs=tuple(_measure_outputs(snapshot)),
    )


def _measure_outputs(snapshot: Snapshot) -> list[tuple[str, str, str]]:
    frame = snapshot.frame
    included = {
        decision.effect: decision.label for decision in frame.plan.decisions if decision.included
    }
    return [
        (
            "Contrast",
            f"{float(np.ptp(frame.profile)):.1f} grey levels",
            "Swing of the profile: the largest value minus the smallest.",
        ),
        *_measure_periods(snapshot),
        (
            "Effects simulated",
            ", ".join(included.values()) or "none",
            "The effects that the plan includes.",
        ),
        (
            "Simulation time",
            f"{1e3 * snapshot.simulation_seconds:.1f} ms",
            "Time to compute the picture.",
        ),
        *_describe_decoders(snapshot),
    ]


def _describe_decoders(snapshot: Snapshot) -> list[tuple[str, str, str]]:
    rows = []
    for decoder, result in snapshot.results.items():
        name = f"Decoder “{decoder}”"
        rows.append((name, _describe_code(result, snapshot), "The code that it read."))
        if decoder != PAPER_DECODER:
            confidence = result.confidence
            text = "none" if confidence is None else f"{confidence:.3f}"
            meaning = "Lead of the best code over the second best, 0 to 1."
            rows.append((f"Confidence, “{decoder}”", text, meaning))
    return rows


def _describe_code(result: DecodeResult, snapshot: Snapshot) -> str:
    if result.code is None:
        return reason_in(snapshot, result) or "no code read"
    cause = cause_in(snapshot, result)
    verdict = "right" if is_right(result, snapshot.sent) else "wrong"
    if cause is not None:
        verdict += f": {cause.what}"
    if result.payload:
        payload = one_line(result.payload, _LONGEST_PAYLOAD)
        return f"“{payload}”, {verdict}"
    return f"code {result.code}, {verdict}"


def _measure_periods(snapshot: Snapshot) -> list[tuple[str, str, str]]:
    """Return columns per chip and chips per exposure; for other lights, those of the period."""
    camera, sent = snapshot.scene.camera, snapshot.scene.transmitter
    seconds, unit, name = snapshot.light_period, "period", "The light's period"
    if has_chips(sent):
        seconds, unit, name = sent.switching_period, "chip", "Switching period"
    rows = [
        (
            f"Columns per {unit}",
            f"{seconds / camera.readout_time:.2f} columns",
            f"{name} divided by readout time.",
        ),
        (
            "Exposure",
            f"{camera.exposure_time / seconds:.3f} {unit}s",
            f"Exposure time divided by {name[:1].lower()}{name[1:]}.",
        ),
    ]
    if snapshot.bars is not None:
        depth = depth_text(snapshot.bars.peak_to_peak)
        rows.append(("Bars", depth, "The brightest column less the darkest."))
    return rows
