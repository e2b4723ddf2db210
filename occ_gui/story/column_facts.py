"""What the model gives for the rows over the columns: light, packets and threshold.

The rows draw it; they compute nothing themselves.
"""

from occ_model.teaching.light_over_columns import chips_in_exposure, light_over_columns
from occ_model.teaching.packet_fields import (
    PacketField,
    packet_fields,
    received_edges,
    received_fields,
    threshold_levels,
)

__all__ = [
    "PacketField",
    "chips_in_exposure",
    "light_over_columns",
    "packet_fields",
    "received_edges",
    "received_fields",
    "threshold_levels",
]
