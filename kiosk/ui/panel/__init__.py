"""The experimenter's side of the booth: the PIN card, the deeds behind the chords, and the panel."""
