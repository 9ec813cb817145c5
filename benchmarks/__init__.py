"""Measurements of speed; they print a table and assert nothing."""
