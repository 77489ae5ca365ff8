"""What keeps a robot from being run here: the reason, and what its owner can do about it."""

from surefoot.record import record


@record
class Problem:
    """One reason why a robot cannot be run.

    Attributes:
        topic: what is wrong, a word or two: ``legs``, ``sole``, ``limits``.
        reason: what was found, one line.
        remedy: what would help, one line.
    """

    topic: str
    reason: str
    remedy: str


class RefusedError(Exception):
    """Raised inside the import where nothing later can be looked at without what is missing."""

    def __init__(self, topic: str, reason: str, remedy: str):
        super().__init__(reason)
        self.problem = Problem(topic, reason, remedy)
