"""``python -m kiosk`` is ``recollect``."""

from kiosk.cli.front import main

__all__ = ["main"]

if __name__ == "__main__":
    main()
