"""Step 4, record: a folder becomes a Dataset of Records; the signs of all of them are judged together."""
