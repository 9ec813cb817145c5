"""Measured records prepared for a diagnosis: what is compared of them, and faults of the bench put right."""
