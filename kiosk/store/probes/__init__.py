"""Looks at what keeps the data: disk, folder, database, list of places, clock. Nothing of a study is changed."""
