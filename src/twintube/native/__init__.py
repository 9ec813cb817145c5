"""The equations as C: translated by a translator of our own, compiled into one library, called without a copy.

kinds       types of the kernel's subset of Python and what they are in C
expressions expressions of the subset
functions   statements and functions
translate   whole sources to one C text
sources     which equations the library holds
build       translates and compiles the library of this machine
library     loads the library and calls its functions
compiler    a C compiler, for this machine or any platform
headers     the equations as headers for FMUs
units       the libraries of FMUs, and the explorer's module
made        what there is for each platform

Standard library only, but for arrays that a caller brings.
"""
