"""Commands for what is stored: listing, copying, checking, withdrawing, merging, exporting, playing again."""
