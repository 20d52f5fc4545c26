"""The forms that a data set may take: Psych-DS, or names like those of BIDS."""
