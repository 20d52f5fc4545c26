"""The command that lays a decision open, its case files, and the table of all reasons."""
