"""Step 3, check: what is wrong with quantities, header names and parts of a record. Checks change nothing."""
