"""Keeps the kiosk up: starts it, hears whether it is alive, ends it when it hangs, starts it again.

It stands beside the other rooms and knows none of them: whatever goes wrong there, this goes on. No window, no data.
"""
