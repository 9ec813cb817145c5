"""One bench for all worlds: what every test of a damper has, whatever the physics of the damper.

plan     what a record is to be, and what it says
motions  what the rig drives
faults   what can be wrong with load cell, stroke sensor and clock
valves   the F-v curve of a parameter set
sampler  from fine steps to the samples of a recorder: filter, mean, jitter, noise, converter
files    dataset.toml and records in the layouts of loggers, and truth.json beside them
"""
