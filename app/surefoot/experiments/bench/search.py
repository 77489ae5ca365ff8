"""Where does survival end on a ladder of levels?"""

from collections.abc import Callable


def bisect_levels(count: int, survives: Callable[[int], bool]) -> int:
    """Index of the greatest level survived, -1 when there is none; assumes that what is weaker is survived too.

    Asks about log2(count + 1) times, so ladders of 7, 15 or 31 levels waste nothing.
    """
    low, high = -1, count
    while high - low > 1:
        middle = (low + high) // 2
        if survives(middle):
            low = middle
        else:
            high = middle
    return low


def every_level(count: int, survives: Callable[[int], bool]) -> int:
    """Index of the last level before the first that is not survived, -1 when there is none; asks about all of them."""
    answers = [survives(i) for i in range(count)]
    return answers.index(False) - 1 if False in answers else count - 1
