"""Excitations: the blocks of the paper's test rig and its measurement plan."""

from twintube.rig.signals import Signal, harmonic_block

__all__ = ["Signal", "harmonic_block"]
