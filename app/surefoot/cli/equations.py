"""``surefoot equations``: who owns which equation of the paper."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Equations:
    """Print which function owns which equation of the paper."""

    def main(self) -> None:
        """Print it."""
        from surefoot.equation_ledger import markdown_table

        print(markdown_table())
