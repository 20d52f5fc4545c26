"""``python -m kiosk`` is ``recollect``."""

from kiosk.cli.main import main

__all__ = ["main"]

if __name__ == "__main__":
    main()
