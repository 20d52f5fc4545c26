"""The tables of the data set: what they are about, and every column of them."""
