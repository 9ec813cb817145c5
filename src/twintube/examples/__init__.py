"""Data that `twintube example` copies.

`bench_SA8` is made: damper SA8 by equations that were not the model's, with a heat balance whose oil thins after Vogel
(154 J/K, 38.9 s). What made it is in the history of the repository, `worlds/example.py` before version 0.2.
"""
