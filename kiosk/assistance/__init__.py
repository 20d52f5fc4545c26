"""Decide how much to help, which card to point to, and how to say it."""
