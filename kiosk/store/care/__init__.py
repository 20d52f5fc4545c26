"""Looking after what is stored: copies, checks, room, and what people ask to be taken out or brought together."""
