"""The model, standard library only: what travels inside the FMU.

variables   the one table: names, symbols, units, bounds, sources
messages    what the checks say, for both kinds of FMU
consistency what must hold between parameters, in the kernel's subset
agreement   whether a velocity belongs to its stroke, in the kernel's subset
checks      messages about a parameter set and its inputs
instance    a damper that is stepped from outside, for the Python FMU
outputs     the outputs as they follow from the state
kernel/     the paper's equations
effects/    physics beyond the paper, one file each
frame       what the effects share
model       the kernel with the effects around it
sources     the files of the equations, for the translation to C
"""
