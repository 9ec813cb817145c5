"""A quarter car on a class D road with the damper as FMU, driven by fmpy."""
