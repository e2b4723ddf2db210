"""Connect to a dask cluster, whose workers can do a sweep."""

import asyncio
import logging
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Any

from occ_model.errors import OccError, one_line, shown

_SECONDS = 5  # timeout of a scheduler's answer


class ClusterError(OccError):
    """A cluster cannot be reached, or has no workers."""


@contextmanager
def cluster_executor(address: str) -> Iterator[Executor]:
    """Return an executor on the dask cluster of a scheduler such as ``tcp://10.0.0.5:8786``."""
    try:
        from distributed import Client
    except ImportError:
        raise ClusterError(
            "A cluster needs the package distributed: pip install 'occ-explorer[cluster]'."
        ) from None
    # A connection that fails is reported below in one sentence, instead of dask's log.
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    if not asyncio.run(_workers(address)):
        raise ClusterError(
            f"The cluster at {shown(address)} has no workers; start one with "
            f"'dask worker {one_line(address)}'."
        )
    client: Any = Client(address, timeout=_SECONDS, set_as_default=False)
    try:
        yield client.get_executor()
    finally:
        client.close(timeout=_SECONDS)


async def _workers(address: str) -> int:
    """Ask a scheduler for its number of workers: a client without a scheduler is slow to close."""
    from distributed.core import rpc
    from distributed.security import Security

    try:
        # As the client does: certificates for tls:// come from dask's configuration.
        keys: Any = Security().get_connection_args("client")
        async with asyncio.timeout(_SECONDS):
            async with rpc(address, connection_args=keys) as scheduler:
                known = await scheduler.identity()
            return len(known["workers"])
    except TimeoutError:
        reason = f"no answer within {_SECONDS} s"
    except Exception as error:  # noqa: BLE001 - whatever may listen there can answer anything
        reason = " ".join(str(error).split()).rstrip(".") or type(error).__name__
    raise ClusterError(
        f"No dask scheduler answers at {shown(address)}: {one_line(reason)}. Allowed: the address "
        "of one, such as tcp://127.0.0.1:8786."
    )
