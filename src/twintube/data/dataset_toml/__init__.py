"""What `dataset.toml` may say and what it says: keys, channels, records, states of filling."""
