"""The two layers that decide the help: a frozen Q-table says how much, the mentaliser says where, and why.

This room knows the game and nothing else. It is handed its mentaliser and its sentences, so it cannot know which
condition of a study it serves.
"""
