"""What a study declares in files of its own: its questionnaires, and what it tells its visitors."""
