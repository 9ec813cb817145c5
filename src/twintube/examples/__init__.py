"""Data that `twintube example` copies."""
