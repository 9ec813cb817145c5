"""Step 2, convert: columns become quantities in SI units; names, units, cells and times as test benches write them."""
