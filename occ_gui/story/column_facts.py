"""The model's functions that the rows of the story call: light, packets, threshold, decoders.

All other modules of the rows only draw, and import nothing that computes.
"""

from occ_model.receiver.decode import QUICK_DECODERS as READ_BY_ALL
from occ_model.teaching.light_over_columns import chips_in_exposure, light_over_columns
from occ_model.teaching.packet_fields import (
    PacketField,
    packet_fields,
    received_edges,
    received_fields,
    threshold_levels,
)

__all__ = [
    "READ_BY_ALL",
    "PacketField",
    "chips_in_exposure",
    "light_over_columns",
    "packet_fields",
    "received_edges",
    "received_fields",
    "threshold_levels",
]
