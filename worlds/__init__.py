"""Makers of bench data that are not the model, to test methods with. Not part of the installed package."""
