"""The model, standard library only: what travels inside the FMU.

variables   the one table: names, symbols, units, bounds, sources
checks      what a parameter set and an input must fulfil
kernel/     the paper's equations
effects/    physics beyond the paper, one file each
frame       what the effects share
model       the kernel with the effects around it
sources     the files of the equations in calling order, for all who compile, translate or fingerprint them
"""
