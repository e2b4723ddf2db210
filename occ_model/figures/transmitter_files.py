"""Write all that is needed to blink a scene: sketch, waveform, wiring and scene."""

from pathlib import Path

from occ_model.boards.sketch import file_names, source_text
from occ_model.boards.transmission import Transmission
from occ_model.boards.waveform_files import HEADER, edge_rows, vcd_text, wav_bytes
from occ_model.errors import OutputError
from occ_model.figures.drawing import figure_bytes, house_style, table_text
from occ_model.figures.wiring import wiring_figure
from occ_model.files.writing import make_folder, write_whole
from occ_model.scene.provenance import Provenance


def write_transmitter_files(folder: Path, sent: Transmission) -> tuple[list[Path], str]:
    """Write the files into a folder, all or none; the scene has the frequency that is really sent.

    Returns their paths, and a sentence on why there is no WAV file, or an empty one.
    """
    contents, missing = _contents(folder, sent)
    make_folder(folder)
    for name, content in contents.items():
        write_whole(folder / name, content)
    return [folder / name for name in contents], missing


def _contents(folder: Path, sent: Transmission) -> tuple[dict[str, bytes], str]:
    sketch, table, vcd, wav, pdf, svg, png, scene = file_names(folder, sent.board)
    contents = {
        sketch: source_text(sent).encode("utf-8"),
        table: table_text(HEADER, edge_rows(sent), provenance(sent)).encode("utf-8"),
        vcd: vcd_text(sent).encode("ascii"),
        pdf: wiring_bytes(sent, "pdf"),
        svg: wiring_bytes(sent, "svg"),
        png: wiring_bytes(sent, "png"),
        scene: sent.sent_scene.to_toml().encode("utf-8"),
    }
    try:
        contents[wav] = wav_bytes(sent)
    except OutputError as error:
        return contents, str(error)
    return contents, ""


def wiring_bytes(sent: Transmission, format_name: str) -> bytes:
    """Encode the figure of the wiring as PNG, SVG or PDF."""
    with house_style():
        return figure_bytes(wiring_figure(sent), format_name, provenance(sent))


def provenance(sent: Transmission) -> Provenance:
    """State which scene, with which frequency, is sent."""
    return Provenance(f"Transmitter: {sent.board.title}", {"sent": sent.sent_scene})
