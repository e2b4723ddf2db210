"""The measurement that follows from the choices of the pane."""

from dataclasses import replace

from occ_gui.bench.bench_choice import PUBLISHED, BenchChoice
from occ_model.camera.projection import panel_corners
from occ_model.effects.paper_view import region_of
from occ_model.errors import ParameterError
from occ_model.results.bench import BenchRequest
from occ_model.scene.scene import Scene


def request_of(choice: BenchChoice, scene: Scene) -> BenchRequest:
    """Make the request.

    ``scene``: its scheme, number of bits, switching frequency, readout time and the columns of its
    panel are used, where its own code is measured.
    """
    request = BenchRequest(decoders=choice.decoders, bits=choice.bits)
    if choice.whose == PUBLISHED:
        return request
    sent, camera = scene.transmitter, scene.camera
    if sent.pattern:
        raise ParameterError("The scene sends a raw chip pattern, which has no bits to count.")
    region = region_of(panel_corners(scene), camera.rows, camera.columns)
    if region is None:
        raise ParameterError("The scene's picture shows no panel.")
    return replace(
        request,
        schemes=(f"{sent.line_code}/{sent.framing}",),
        payload_bits=sent.payload_length,
        preamble=sent.preamble,
        error_correction=sent.error_correction,
        rows_a_symbol=sent.switching_period / camera.readout_time,
        rows=region.columns,
        readout_time=camera.readout_time,
    )


def setting_of(request: BenchRequest) -> BenchRequest:
    """Return a request without its decoders and its effort, which change no curve."""
    return replace(request, decoders=(), bits=1)
