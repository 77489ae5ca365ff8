"""``python -m app`` is ``surefoot``."""

from app.cli import main

if __name__ == "__main__":
    main()
