"""What all figures share: their look, and how they become files."""

from contextlib import AbstractContextManager
from io import BytesIO
from pathlib import Path
from typing import Any

from matplotlib import rc_context, rcParamsDefault
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.errors import OutputError
from occ_model.files.writing import write_whole
from occ_model.scene.provenance import Provenance

# The styles tell the lines apart in grey print, too.
SIMULATION = {"color": colours.SIMULATION, "linestyle": "-"}
BAND = {"color": colours.BAND, "linestyle": "--"}
PHOTO = {"color": colours.PHOTO, "linestyle": ":"}

FORMATS = ("png", "svg", "pdf")
"""What figures are written in."""

_LOOK: dict[Any, Any] = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "figure.constrained_layout.use": True,
    "savefig.dpi": 200,
    "pdf.fonttype": 42,
    "svg.hashsalt": "occ_model",  # the same figure is the same file
}


def house_style() -> AbstractContextManager[None]:
    """Give all figures drawn within the same look, whatever has been set before."""
    # The backend opens windows; a figure that becomes a file has none.
    defaults = {name: value for name, value in rcParamsDefault.items() if name != "backend"}
    return rc_context(defaults | _LOOK)


def write_figure(path: Path, figure: Figure, provenance: Provenance) -> None:
    """Write a figure in the format that the file's ending names, its provenance inside.

    To be called within the house style, in which the figure was drawn.

    Raises
    ------
    OutputError
        The ending names no format of figures, or the file cannot be written.
    """
    write_whole(path, figure_bytes(figure, figure_format(path), provenance))


def figure_format(path: Path) -> str:
    """Say which format a file's ending names.

    Raises
    ------
    OutputError
        None of those that figures are written in.
    """
    ending = path.suffix.lower().removeprefix(".")
    if ending not in FORMATS:
        raise OutputError(f"{path.name} has no ending of a figure; use .png, .svg or .pdf.")
    return ending


def figure_bytes(figure: Figure, format_name: str, provenance: Provenance) -> bytes:
    """Encode a figure, its provenance inside."""
    title, text = provenance.title, provenance.text()
    metadata: dict[str, dict[str, str | None]] = {
        "pdf": {"Title": title, "Subject": text, "CreationDate": None},
        "svg": {"Title": title, "Description": text, "Date": None},
        "png": {"Title": title, "Description": text},
    }
    buffer = BytesIO()
    figure.savefig(buffer, format=format_name, metadata=metadata[format_name])
    return buffer.getvalue()


def save_figure(figure: Figure, folder: Path, name: str, provenance: Provenance) -> None:
    """Write a figure as PDF and as PNG, its provenance inside.

    To be called within the house style, in which the figure was drawn.

    Raises
    ------
    OutputError
        A file cannot be written.
    """
    for ending in ("pdf", "png"):
        write_figure(folder / f"{name}.{ending}", figure, provenance)
