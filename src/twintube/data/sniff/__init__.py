"""Guesses from the files themselves, for a new `dataset.toml` and for columns that it does not name yet."""
