"""SQLite, append only: what happened is written once and never changed. No other room knows of a database."""
