"""Every way that a visitor may try to leave the kiosk, tried from outside: ``python -m tests.ui.exits``."""
