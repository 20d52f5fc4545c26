"""SQLite, append only: what happened is written once and never changed. No other package knows of a database."""
