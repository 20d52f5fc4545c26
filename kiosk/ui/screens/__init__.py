"""What is on the screens: one small object each, which shows what it is told and says what was done to it."""
