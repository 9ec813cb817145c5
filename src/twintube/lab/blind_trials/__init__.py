"""Measured datasets in which an effect, a fault or nothing is hidden, made by equations of their own.

Nothing here uses the kernel or the effects of `twintube`: only a damper's numbers come from there.
"""
