"""The experimenter's side of the booth: the PIN card, the actions behind the shortcuts, and the panel."""
