"""Wrong tokens: who pays for them, and who does not."""

import asyncio

import pytest

from surefoot.dashboard.access.token_throttle import TokenThrottle, guesser


def test_who_guesses_much_is_put_off_and_nobody_else():
    async def guess():
        guesses = TokenThrottle(pause_s=0.0, most=2)
        first, second = (asyncio.ensure_future(guesses.pay("there")) for _ in range(2))
        await asyncio.sleep(0)
        assert guesses.too_many("there")
        assert not guesses.too_many("elsewhere")
        await asyncio.gather(first, second)
        assert not guesses.too_many("there")
        assert not guesses._waiting  # addresses are not kept

    asyncio.run(guess())


@pytest.mark.parametrize(
    ("peer", "forwarded_for", "behind_proxy", "who"),
    [
        ("192.168.1.7", "", False, "192.168.1.7"),
        ("2001:db8:1:2::7", "", False, "2001:db8:1:2::/64"),  # a home has 2^64 addresses, and counts once
        ("2001:db8:1:2:ffff::8", "", False, "2001:db8:1:2::/64"),
        ("::ffff:192.168.1.7", "", False, "192.168.1.7"),
        ("127.0.0.1", "203.0.113.9", False, "127.0.0.1"),  # no proxy is expected: anybody may write this header
        ("127.0.0.1", "203.0.113.9", True, "203.0.113.9"),
        ("127.0.0.1", "198.51.100.1, 203.0.113.9", True, "203.0.113.9"),  # the last one is the proxy's
        ("192.168.1.7", "203.0.113.9", True, "192.168.1.7"),  # past the proxy
        ("127.0.0.1", "", True, "127.0.0.1"),
        ("", "", True, ""),
    ],
)
def test_a_guess_counts_for_the_home_that_it_comes_from(peer, forwarded_for, behind_proxy, who):
    assert guesser(peer, forwarded_for, behind_proxy=behind_proxy) == who
