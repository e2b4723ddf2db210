"""Every decoder reads every scheme or refuses it with a sentence."""

import itertools

import numpy as np
import pytest
from amount import amount
from each_case import each_case

import occ_model as occ
from occ_model.receiver.decode import DECODERS
from occ_model.transmitter import registry

LINE_CODES = registry.LINE_CODES.load_built_in()
FRAMINGS = registry.FRAMINGS.load_built_in()

SCENE = occ.load_preset("phone-68us").replace(
    switching_frequency=4e3, distance=0.6, rows=100, bits=8, code=0b10110010
)
"""At 60 cm the panel fills the picture, with 110 chips of 31 columns."""

SCHEMES = [
    (code, framing)
    for code, framing in itertools.product(LINE_CODES, FRAMINGS)
    if (code, framing) != ("nrz", "c-ook")
]

REFUSED = {
    # 8 bits of length, 8 of payload and 16 of check sum with 6 chips each, and a preamble of 14.
    ("fsk", "raw"): ("of 206 chips fit the panel's image", " chips of its 206"),
    # From another start the chips are those of code 29.
    ("8b10b", "paper"): ("2 payloads fit the chips", "29 and 178 send the same endless chips"),
}
"""Parts of the sentences on these schemes for this scene."""


def signal(scene: occ.Scene, start: float) -> np.ndarray:
    """Return the signal without enhancement of packets with any start."""
    return occ.column_profile(scene.replace(start_time=start))


@pytest.mark.parametrize(
    ("decoder", "code", "framing"),
    [
        # By default each scheme is tried with one of the four decoders.
        pytest.param(decoder, *scheme, marks=pytest.mark.whole if (place + number) % 4 else ())
        for place, decoder in enumerate(DECODERS)
        for number, scheme in enumerate(SCHEMES)
    ],
)
def test_every_scheme_is_read_or_refused_with_a_sentence(
    code: str, framing: str, decoder: str
) -> None:
    scene = SCENE.replace(line_code=code, framing=framing, enhancement="none")
    for start in (1.37e-3, 5.9e-3, 0.0)[: amount(1, 3)]:
        result = occ.decode(signal(scene, start), scene, decoder)
        if (code, framing) in REFUSED:
            assert any(said in result.failure for said in REFUSED[code, framing])
        else:
            assert result.failure is None
            assert result.code == scene.transmitter.code
            assert tuple(result.bits.tolist()) == scene.transmitter.payload_bits


@each_case(
    itertools.product(
        ("manchester", "4b6b", "8b10b"),
        ("none", "reed-solomon"),
        [name for name in DECODERS if name != "matched"],
    )
)
def test_a_text_is_returned_as_a_text(code: str, correction: str, decoder: str) -> None:
    scene = SCENE.replace(
        line_code=code, framing="raw", payload="text:HELLO", error_correction=correction,
        switching_frequency=14e3, exposure_time=40e-6, enhancement="none",
    )  # fmt: skip
    result = occ.decode(signal(scene, 2e-3), scene, decoder)
    assert result.failure is None
    assert result.payload == "HELLO"


@pytest.mark.parametrize(("payload", "most"), [("text:HELLO", 12), ("hex:0123456789", 12)])
def test_the_matched_decoder_refuses_too_many_payloads(payload: str, most: int) -> None:
    scene = SCENE.replace(line_code="manchester", payload=payload)
    result = occ.decode(signal(scene, 0.0), scene, "matched")
    assert result.failure == (
        "The payload has 40 bits; the matched decoder compares all payloads, at most "
        f"{most} bits for this scheme: use the sequence detector."
    )


def test_wrong_bits_of_a_text_are_shown_with_the_failure() -> None:
    scene = SCENE.replace(
        line_code="nrz", framing="raw", payload="text:HELLO", switching_frequency=6e3,
        enhancement="none",
    )  # fmt: skip
    levels = signal(scene, 0.0)
    columns = 1 / 6e3 / 8e-6
    # The panel's first chips are dark and thus outside the region; a chip of the fourth letter is
    # inverted.
    place = int((13 + 8 + 24 + 0.2) * columns)
    levels[place : place + int(columns)] = levels.max()
    result = occ.decode(levels[: int(100 * columns)], scene)
    assert result.failure == "The check sum (CRC-16) does not match: some chips were misread."
    assert result.payload == "HEL?O"
    assert result.code is None


@each_case(SCHEMES[:: amount(2, 1)])
def test_a_payload_is_refused_or_right_at_any_exposure(code: str, framing: str) -> None:
    random = np.random.default_rng(7)
    for chips in np.linspace(0.5, 3.0, 12)[:: amount(4, 1)]:
        scene = SCENE.replace(
            line_code=code, framing=framing, code=int(random.integers(256)), enhancement="none",
            exposure_time=136e-6, switching_frequency=float(chips) / 136e-6,
        )  # fmt: skip
        levels = signal(scene, float(random.uniform(0.0, 0.01)))
        levels += random.normal(0.0, 0.3, len(levels))
        for decoder in ("threshold", "matched"):
            assert occ.decode(levels, scene, decoder).code in (None, scene.transmitter.code)


@each_case(itertools.product((0, 1, 4, 6, 15, 79, 255), (0.5, 1.5, 2.5)))
def test_payloads_with_many_or_few_lit_chips_are_not_mistaken_for_others(
    code: int, chips: float
) -> None:
    # NRZ lights one chip for each 1 of the payload, so payloads differ in their levels.
    scene = SCENE.replace(
        line_code="nrz", framing="paper", code=code, enhancement="none", exposure_time=chips / 4e3
    )
    assert occ.decode(signal(scene, 0.0), scene, "matched").code in (None, code)


@pytest.mark.parametrize(("line_code", "chips"), [("manchester", 4), ("manchester", 8), ("nrz", 4)])
def test_no_payload_is_read_if_two_explain_everything(line_code: str, chips: int) -> None:
    # A whole number of chips leaves few levels, and another payload has the same order of them.
    scenes = [
        SCENE.replace(
            line_code=line_code, framing="paper", code=code, enhancement="none",
            exposure_time=chips / 4e3,
        )
        for code in (2, 3, 16, 66, 84, 85, 87, 93)
    ]  # fmt: skip
    results = [occ.decode(signal(scene, 0.0), scene, "matched") for scene in scenes]
    assert all(
        result.code in (None, scene.transmitter.code)
        for scene, result in zip(scenes, results, strict=True)
    )
    assert any("No code stands out" in (result.failure or "") for result in results)


def test_a_payload_is_read_if_another_one_has_no_stripes() -> None:
    # With an exposure of 4 of the 12 chips of a frame, one payload gives all columns the same
    # light.
    scene = SCENE.replace(
        line_code="nrz", framing="paper", code=77, enhancement="none",
        switching_frequency=4096.0, exposure_time=2.0**-10,
    )  # fmt: skip
    result = occ.decode(signal(scene, 0.0), scene, "matched")
    assert (result.code, result.failure) == (77, None)


@pytest.mark.parametrize("chips", [1.2, 1.5])
def test_the_threshold_reads_checked_chips_of_exposures_longer_than_one(chips: float) -> None:
    scene = SCENE.replace(
        line_code="fsk", framing="paper", enhancement="none", exposure_time=chips / 4e3
    )
    assert occ.decode(signal(scene, 0.0), scene).code == scene.transmitter.code


@pytest.mark.parametrize("bits", [63, 65, 127, 128])
def test_the_length_in_a_header_is_that_of_the_payload(bits: int) -> None:
    # A frame of 128 bits states its length in 16 bits, one of 65 in 8 that differ from those for
    # 64.
    payload = "bits:" + "".join(map(str, np.random.default_rng(bits).integers(0, 2, bits)))
    scene = SCENE.replace(
        payload=payload, framing="raw", line_code="manchester", enhancement="none",
        switching_frequency=15e3,
    )  # fmt: skip
    for decoder in ("threshold", "sequence"):
        result = occ.decode(signal(scene, 1.37e-3), scene, decoder)
        assert result.failure is None
        assert tuple(result.bits.tolist()) == scene.transmitter.payload_bits


@pytest.mark.parametrize(
    ("decoder", "bits", "codes", "exposures", "read"),
    [
        ("sequence", 4, (1, 5, 7, 9), (2.7, 3.7), 4),
        ("equalizer", 8, (48, 93, 102, 111), (3.4, 4.6, 5.5), 3),
    ],
)
def test_chips_that_no_rule_refuses_are_read_correctly_or_not_at_all(
    decoder: str, bits: int, codes: tuple[int, ...], exposures: tuple[float, ...], read: int
) -> None:
    base = occ.Scene().replace(
        line_code="nrz", framing="paper", bits=bits, code=0, enhancement="none", columns=1500
    )
    found = []
    for code in codes:
        for chips in exposures:
            scene = base.replace(code=code, exposure_time=chips / 10e3)
            signal = 40.0 + 160.0 * occ.on_time(scene) / scene.camera.exposure_time
            result = occ.decode(signal, scene, decoder)
            found += [] if result.code is None else [result.code == code]
    assert found == [True] * read
