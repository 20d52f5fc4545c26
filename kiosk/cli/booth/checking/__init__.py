"""What ``recollect check`` is made of: the list of all looks, how they go on at once, and what no room looks at."""
