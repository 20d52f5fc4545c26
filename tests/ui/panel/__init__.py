"""The experimenter at the booth, by chord and by panel, in the real kiosk."""
