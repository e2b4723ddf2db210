"""What all figures share: their look, and how they become files."""

from contextlib import AbstractContextManager
from io import BytesIO
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.export.provenance import Provenance
from occ_model.output import write_whole

# The styles tell the lines apart in grey print, too.
SIMULATION = {"color": colours.SIMULATION, "linestyle": "-"}
BAND = {"color": colours.BAND, "linestyle": "--"}
PHOTO = {"color": colours.PHOTO, "linestyle": ":"}

_LOOK: dict[Any, Any] = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "figure.constrained_layout.use": True,
    "savefig.dpi": 200,
    "pdf.fonttype": 42,
}


def house_style() -> AbstractContextManager[None]:
    """Give all figures drawn within the same look."""
    return rc_context(_LOOK)


def save_figure(figure: Figure, folder: Path, name: str, provenance: Provenance) -> None:
    """Write a figure as PDF and as PNG, its provenance inside.

    To be called within the house style, in which the figure was drawn.

    Raises
    ------
    OutputError
        A file cannot be written.
    """
    text = provenance.text()
    metadata = {
        "pdf": {"Title": provenance.title, "Subject": text, "CreationDate": None},
        "png": {"Title": provenance.title, "Description": text},
    }
    for ending, fields in metadata.items():
        buffer = BytesIO()
        figure.savefig(buffer, format=ending, metadata=fields)
        write_whole(folder / f"{name}.{ending}", buffer.getvalue())
