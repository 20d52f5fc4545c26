"""Commands at a booth: opening and keeping the kiosk, checking and rehearsing it, and the processes it starts."""
