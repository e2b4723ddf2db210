"""The example of CamComSim, a published simulator of films, as a film of this program.

A frame of 33.3 ms with a gap of 0.2, 8,000 chips a second, packets of 8 bits of header and 16 of
payload in Manchester code after 4 chips of start, repeated (``vlc-citi-lab/camcomsim``,
``simu_params_template.json``). Its 52 chips are those of 24 bits behind the header 1 1 1 0.
"""

from fractions import Fraction

from occ_model.scene.scene import Scene
from occ_model.study.films.study import FilmRequest, scene_of_films

FRAME_PERIOD = Fraction(333, 10_000)  # seconds from frame to frame
GAP = Fraction(1, 5)  # fraction of the frame period
FREQUENCY = 8000.0
PACKET_CHIPS = 4 + 2 * (8 + 16)

_EXPOSURE = 25e-6  # a fifth of a chip, assumed: the example states no exposure time
_STEP = Fraction(1, 10_000)  # time step of the published simulator in seconds
_ERRORS = Fraction(1, 100)  # fraction of the packets in view that it loses


def example_request(frames: int = 333, seed: int = 1) -> FilmRequest:
    """Return the example as a film of frames, whose starts within a packet repeat after 65."""
    scene = scene_of_films(Scene()).replace(
        line_code="manchester", framing="paper", exposure_time=_EXPOSURE, iso=800.0
    )
    return FilmRequest(
        scene,
        frequencies=(FREQUENCY,),
        gaps=(float(GAP),),
        bits=(24,),
        frame_rate=float(1 / FRAME_PERIOD),
        frames=frames,
        seed=seed,
    )


def published_rule() -> Fraction:
    """Return the fraction of packets that the published simulator's own rule receives.

    It states no figure. Its rule: the time in view is rounded up to whole milliseconds, a packet is
    received where it starts early enough to end before, and one in a hundred of those is lost.
    Starts are spread evenly over a frame, as each is shifted by up to 0.9 ms at random.
    """
    frame = round(FRAME_PERIOD / _STEP)
    view = -(-(FRAME_PERIOD * (1 - GAP)) // Fraction(1, 1000)) * 10
    packet = round(PACKET_CHIPS / Fraction(FREQUENCY) / _STEP)
    return Fraction(max(view - packet, 0), frame) * (1 - _ERRORS)
