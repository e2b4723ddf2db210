"""What three colours bring: the figures of colour in ``resources/docs/validation.md``.

``python tests/benchmarks/colour.py PART``, or all parts in turn:

* ``peer``: the example of python-vlc-rolling, a symbol of 100 us exposed for 85 us and 18.904 us a
  line, by the law in its source, where a line has the symbol in which it begins, and by the
  integral: levels, and the RMS difference in percent of full light;
* ``rates``: bits a second of three codes and of one, at 30 pictures a second, from pictures of
  random codes, start times and seeds, with the interval of Wilson (95 %);
* ``study``: bits read in pictures, and by the study of ``scene.colour(...)``, with chi-square;
* ``csk``: the highest frequency up to which all of 12 packets are read;
* ``stripes``: false stripes of a white lamp close to the line rate, and their closed form;
* ``cost``: processor time of a colour picture against the monochrome one;
* ``figure``: draw false-stripes.png in the present folder.
"""

import argparse
import time
from collections.abc import Iterator

import numpy as np

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.camera.exposure import lit_fraction
from occ_model.camera.mosaic import light_of_greys
from occ_model.scene.colour_scenes import led_scene
from occ_model.scene.csk import PARTS, POINTS, symbols_of
from occ_model.scene.scene import Scene

PHONE = "0.864 0.044 0.091 / 0.129 0.222 0.649 / 0.029 0.045 0.926"
MIXINGS: dict[str, dict[str, float | str]] = {
    "0 %": {}, "10 %": {"crosstalk": 0.1}, "30 %": {"crosstalk": 0.3}, "phone's": {"mixing": PHONE},
}  # fmt: skip
FILES: dict[str, dict[str, float | str]] = {
    "none": {}, "4:2:0": {"jpeg_quality": 90}, "4:4:4": {"jpeg_quality": 90, "chroma": "full"},
}  # fmt: skip
PICTURES, RATE = 12, 30.0
CODES = 150  # of a cell, in pictures and by the study
QUIET = {"sensor-noise": False, "fixed-pattern": False}
LIT = 3600.0 / (3600.0 + 290.0 * 0.4 / np.pi)  # fraction of a lit panel's light that is its own
ROWS = {"rows": 576, "panel_height": 0.075}  # an eighth of the picture's rows


def colour_scene(exposure: float, frequency: float, **changes: float | str) -> Scene:
    scene = occ.load_preset("phone-68us-colour").replace(crosstalk=0.0, exposure_time=exposure)
    return scene.replace(switching_frequency=frequency, **ROWS, **changes)


def random_scenes(scene: Scene, count: int, seed: int) -> Iterator[tuple[Scene, int]]:
    random = np.random.default_rng(seed)
    for _ in range(count):
        red, green, blue = random.integers(0, 1024, 3).tolist()
        start = float(random.uniform(0.0, 0.01))
        sent = scene.replace(code=red, green_code=green, blue_code=blue, start_time=start)
        yield sent, int(random.integers(2**31))


def sent_codes(scene: Scene) -> tuple[int, ...]:
    return scene.transmitter.code, scene.colours.green_code, scene.colours.blue_code


def right_codes(scene: Scene, decoders: tuple[str, ...], count: int, seed: int) -> FloatArray:
    """Count the codes read of each decoder and colour, shape (decoders, 3)."""
    right = np.zeros((len(decoders), 3))
    for sent, picture_seed in random_scenes(scene, count, seed):
        image = occ.render_colour(sent, seed=picture_seed).image
        for place, decoder in enumerate(decoders):
            reading = occ.decode_colours(image, sent, decoder)
            pairs = zip(reading.results, sent_codes(sent), strict=True)
            right[place] += [result.code == code for result, code in pairs]
    return right


def peer() -> None:
    print("peer: levels theirs, ours; RMS difference in % of full light, red, green, blue")
    scene = occ.load_preset("phone-68us-colour").replace(
        switching_frequency=10e3, exposure_time=85e-6, readout_time=18.904e-6, columns=1000
    )
    for kind in ("three-codes", "4-csk", "8-csk", "16-csk"):
        own = scene.replace(colour_light=kind)
        begins = np.floor(np.arange(1000) * 18.904e-6 * 10e3).astype(int)
        sizes: list[float] = []
        levels: tuple[set[float], set[float]] = set(), set()
        for index in range(3):
            exact = lit_fraction(led_scene(own, index))
            if kind == "three-codes":
                code = sent_codes(own)[index]
                symbols = occ.packet(own.replace(code=code)).astype(float)
            else:
                labels = symbols_of(kind, own.transmitter.payload_bits)
                symbols = np.array([0, 0, *(POINTS[kind][n][index] for n in labels)]) / PARTS
            theirs = symbols[begins % len(symbols)]
            theirs[0] = symbols[1]  # the first line has the second symbol
            sizes.append(100.0 * float(np.sqrt(np.mean((theirs - exact) ** 2))))
            levels[0].update(np.round(theirs, 6))
            levels[1].update(np.round(exact, 6))
        print(kind, *map(len, levels), *(f"{size:.1f}" for size in sizes))


def rates() -> None:
    print("rates: codes read of red, green, blue; bits a second")
    decoders = "threshold", "matched"
    for exposure, frequency in ((68e-6, 20e3), (68e-6, 60e3), (136e-6, 10e3), (136e-6, 60e3)):
        where = f"{exposure * 1e6:.0f} us {frequency / 1e3:.0f} kHz"
        for file, stored in FILES.items():
            for name, mixing in MIXINGS.items():
                scene = colour_scene(exposure, frequency, **stored, **mixing)
                right = right_codes(scene, decoders, PICTURES, 71)
                for decoder, codes in zip(decoders, right, strict=True):
                    rate = bits_a_second(int(codes.sum()), 3)
                    print(where, file, name, decoder, codes.astype(int).tolist(), rate)
        one = colour_scene(exposure, frequency).replace(bayer="none", colour_light="white")
        sent = list(random_scenes(one, PICTURES, 72))
        images = [occ.render(scene, seed=seed).image for scene, seed in sent]
        for decoder in decoders:
            pairs = zip(images, sent, strict=True)
            results = [(occ.decode(image, own, decoder).code, own) for image, (own, _) in pairs]
            read = sum(code == own.transmitter.code for code, own in results)
            print(where, "one code, monochrome", decoder, read, bits_a_second(read, 1))


def bits_a_second(read: int, codes: int) -> str:
    """Return the rate of pictures with some codes each, with its interval."""
    tried, most = codes * PICTURES, codes * 10 * RATE
    low, high = occ.wilson_interval(read, tried)
    return f"{most * read / tried:.0f} ({most * low:.0f} to {most * high:.0f})"


def study() -> None:
    print(f"study: codes of {CODES} read, in pictures and by the study; chi-square, cells")
    total, cells = 0.0, 0
    for name in ("0 %", "30 %"):
        for frequency in (10.4e3, 10.8e3, 11.2e3, 11.6e3):
            scene = colour_scene(136e-6, frequency, demosaicing="none", **MIXINGS[name])
            (pictures,) = right_codes(scene, ("threshold",), CODES, 91)
            studied = np.zeros(3)
            for place, colour in enumerate(("red", "green", "blue")):
                for sent, seed in random_scenes(scene, CODES, 92):
                    rate = occ.success_rate(sent.colour(colour), images=1, seed=seed)
                    studied[place] += rate == 100.0
            both = (pictures + studied) / (2 * CODES)
            spread = CODES * both * (1 - both) * 2
            known = spread > 0
            size = float(((pictures - studied)[known] ** 2 / spread[known]).sum())
            total, cells = total + size, cells + int(known.sum())
            print(name, frequency, pictures.astype(int), studied.astype(int), f"{size:.1f}")
    print(f"chi-square {total:.1f} of {cells} cells")


def csk() -> None:
    print(
        "csk: highest frequency in kHz at which all of 12 packets are read, and the first failure"
    )
    for exposure in (68e-6, 136e-6):
        for kind in ("4-csk", "8-csk", "16-csk"):
            for crosstalk in (0.0, 0.3):
                clean, failed = 0.0, 0.0
                for frequency in np.arange(16e3, 81e3, 8e3):
                    scene = colour_scene(
                        exposure, float(frequency), colour_light=kind, crosstalk=crosstalk,
                        demosaicing="none",
                    )  # fmt: skip
                    right = 0
                    for sent, seed in random_scenes(scene, 12, 55):
                        image = occ.render_colour(sent, seed=seed).image
                        result = occ.decode_colours(image, sent).results[0]
                        right += result.code == sent.transmitter.code
                    if right < 12:
                        failed = float(frequency)
                        break
                    clean = float(frequency)
                print(kind, f"{exposure * 1e6:.0f} us", crosstalk, clean / 1e3, failed / 1e3)


def white_lamp(frequency: float, exposure: float, **changes: float) -> Scene:
    """Return a scene of which a white lamp that blinks fills the picture."""
    return occ.load_preset("phone-68us-colour").replace(
        colour_light="white", light="lamp", lamp_frequency=frequency, crosstalk=0.0, rows=64,
        exposure_time=exposure, panel_width=20.0, panel_height=20.0, **changes,
    )  # fmt: skip


def stripes() -> None:
    print("stripes: columns a period, and of the false stripe; its amplitude in red and blue, as a")
    print("  fraction of white light, and its closed form; swing of red, green, blue in levels")
    for frequency in (40e3, 55e3, 62e3):
        for exposure in (10e-6, 68e-6, 136e-6):
            iso = 100.0 * 68e-6 / exposure
            scene = white_lamp(frequency, exposure, iso=iso, start_time=1.234e-3)
            frame = occ.render_colour(scene, force=QUIET)
            light = light_of_greys(scene.camera.gamma)
            seen = light[frame.image[32:34]].mean(axis=0)[8:-8].T
            steady = scene.replace(bayer="none", light="waveform", levels="1")
            full = (occ.column_profile(steady)[0] / 255.0) ** scene.camera.gamma
            false = abs(1 / 16e-6 - frequency) * 8e-6
            # The first harmonic of a lamp that is on for half of each cycle, exposed.
            harmonic = 2 / np.pi * abs(np.sinc(frequency * exposure)) * LIT * full
            expected = harmonic * np.sin(np.pi * frequency * 8e-6) ** 2
            wave = np.exp(-2j * np.pi * false * np.arange(seen.shape[1]))
            red, _, blue = (2 * abs(np.mean((row - row.mean()) * wave)) for row in seen)
            swings = ", ".join(f"{np.ptp(row[8:-8]):.0f}" for row in frame.profiles)
            print(
                f"{frequency / 1e3:.0f} kHz {exposure * 1e6:.0f} us:",
                f"{1 / (frequency * 8e-6):.1f}, {1 / false:.1f};",
                f"{red:.4f}, {blue:.4f}, {expected:.4f}; {swings}",
            )


def figure(file: str = "false-stripes.png") -> None:
    """Draw a white lamp close to the line rate, as the mean of the rows of a colour picture."""
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot

    drawn, axes = pyplot.subplots(3, 1, figsize=(9, 2.8), sharex=True, layout="constrained")
    for axis, frequency in zip(axes, (40e3, 55e3, 62e3), strict=True):
        scene = white_lamp(frequency, 10e-6, iso=4000.0)
        image = occ.render_colour(scene, force=QUIET).image
        seen = image[30:32, 1000:1300].mean(axis=0, keepdims=True) / 255.0
        axis.imshow(seen, aspect="auto", extent=(0, 300, 0, 1))
        false = 1 / abs(1 / 16e-6 - frequency) / 8e-6
        axis.set(yticks=[], ylabel=f"{frequency / 1e3:.0f} kHz")
        axis.set_title(
            f"{1 / (frequency * 8e-6):.1f} columns a period; false stripes of {false:.1f} columns",
            fontsize=9, loc="left",
        )  # fmt: skip
    axes[-1].set_xlabel("column")
    drawn.savefig(file, dpi=110)


def cost() -> None:
    print("cost: processor ms of a colour picture and a monochrome one, ratio (median of 5)")
    cases: dict[str, dict[str, float]] = {
        "noise": {}, "noise, JPEG": {"jpeg_quality": 90}, "noise, blur": {"point_spread": 1.0},
    }  # fmt: skip
    for name, changes in cases.items():
        colour = occ.load_preset("phone-68us-colour").replace(**changes)
        mono = colour.replace(bayer="none", colour_light="white", crosstalk=0.0)
        times = np.zeros((6, 2))
        for seed, row in enumerate(times):
            start = time.process_time()
            occ.render_colour(colour, seed=seed)
            middle = time.process_time()
            assert occ.render(mono, seed=seed).camera_image.size
            row[:] = middle - start, time.process_time() - middle
        first, second = 1e3 * np.median(times[1:], axis=0)
        print(f"{name}: {first:.0f}, {second:.0f}, {first / second:.2f}")


PARTS_OF_REPORT = {part.__name__: part for part in (peer, stripes, cost, csk, study, rates, figure)}

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", nargs="*", choices=[*PARTS_OF_REPORT, []])
    for part in parser.parse_args().part or PARTS_OF_REPORT:
        PARTS_OF_REPORT[part]()
