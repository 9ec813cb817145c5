"""Step 1, read: a file of any format becomes columns by name, unconverted and unjudged."""
