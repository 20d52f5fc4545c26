"""Bringing in a questionnaire from elsewhere: from a CSV table to a TOML file."""
