"""What each stage of a sitting does: how it begins, which events it takes, and what they lead to. None knows the next."""
