"""Measured datasets with a hidden effect, a hidden fault or neither, computed with independent equations.

Nothing here uses the kernel or the effects of `twintube`; only the parameters of a damper come from there.
"""
