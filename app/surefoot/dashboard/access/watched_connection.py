"""A connection whose other side no longer reads is ended, so that nothing is kept for it and nobody waits for it.

A page that is asleep, or whose network went away without a word, leaves its connection open. The websockets' own pings
do not find out: a ping waits like anything else until what was written before has left.
"""

import asyncio

from websockets.asyncio.server import ServerConnection


class WatchedConnection(ServerConnection):
    """Ends itself when nothing of what waits to be sent leaves for a while; a slow line may take longer.

    Attributes:
        patience_s: for how long nothing leaves.
    """

    patience_s = 30.0

    async def drain(self) -> None:
        """Wait until more can be sent. Raises TimeoutError, on which the connection is aborted."""
        while True:
            waits = self.transport.get_write_buffer_size()
            try:
                async with asyncio.timeout(self.patience_s):
                    return await super().drain()
            except TimeoutError:
                if self.transport.get_write_buffer_size() >= waits:
                    raise
