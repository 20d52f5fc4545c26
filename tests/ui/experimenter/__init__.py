"""The experimenter at the booth, by shortcut and by panel, in the real kiosk."""
