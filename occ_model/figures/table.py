"""Write a table as CSV, with its provenance in comment lines."""

import csv
from collections.abc import Iterable, Sequence
from io import StringIO
from pathlib import Path

from occ_model.files.writing import write_whole
from occ_model.scene.provenance import Provenance


def write_table(
    path: Path, header: Sequence[str], rows: Iterable[Sequence[object]], provenance: Provenance
) -> None:
    """Write a table; None becomes an empty cell."""
    write_whole(path, table_text(header, rows, provenance).encode("utf-8"))


def table_text(
    header: Sequence[str], rows: Iterable[Sequence[object]], provenance: Provenance
) -> str:
    """Write a table as text; the arguments are those of :func:`write_table`."""
    text = StringIO()
    for line in provenance.lines():
        text.write(f"# {line}".rstrip() + "\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return text.getvalue()
