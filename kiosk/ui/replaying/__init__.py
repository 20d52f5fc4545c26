"""Stored sittings, played again on the screen."""
