"""Wrong tokens cost time: how much, and whom."""

import asyncio
import ipaddress
from collections import Counter

from surefoot.dashboard.access.origins import LOOPBACK

_PAUSE_S, _MOST_WAITING = 1.0, 8
_IPV6_HOME = 64  # bits of an IPv6 address that a provider gives to one customer


class TokenThrottle:
    """Each wrong token waits, and of one address only so many may wait at once. Nobody else is held up.

    Args:
        pause_s: how long each waits.
        most: of one address at once.
    """

    def __init__(self, pause_s: float = _PAUSE_S, most: int = _MOST_WAITING) -> None:
        self._pause_s, self._most = pause_s, most
        self._waiting: Counter[str] = Counter()

    def too_many(self, address: str) -> bool:
        """Whether an address guesses so much that its next guess is not even looked at."""
        return self._waiting[address] >= self._most

    async def pay(self, address: str) -> None:
        """Wait for a wrong one."""
        self._waiting[address] += 1
        try:
            await asyncio.sleep(self._pause_s)
        finally:
            self._waiting[address] -= 1
            self._waiting += Counter()  # forgets addresses with none


def guesser(peer: str, forwarded_for: str, *, behind_proxy: bool) -> str:
    """Who guesses: one home, so that neither the many addresses of a home nor a proxy's single one mislead.

    Args:
        peer: address of the connection.
        forwarded_for: its X-Forwarded-For header; the last entry is what a proxy added, the others anybody may write.
        behind_proxy: whether a proxy of ours is expected; it is believed when it comes from this machine.
    """
    if behind_proxy and peer in LOOPBACK:
        peer = forwarded_for.rpartition(",")[2].strip() or peer
    try:
        address = ipaddress.ip_address(peer)
    except ValueError:
        return peer
    if isinstance(address, ipaddress.IPv6Address):
        if address.ipv4_mapped is not None:
            return str(address.ipv4_mapped)
        return str(ipaddress.ip_network((int(address), _IPV6_HOME), strict=False))
    return str(address)
