"""What the experimenter may do at the booth, when, and by what they show that they may. No clock, no window."""
