"""The view models of the screens: each shows what it is given and reports what was done."""
