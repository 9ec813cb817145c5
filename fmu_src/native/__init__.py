"""The native FMU: translated equations, a wrapper of FMI 2.0 in C, and their compilation for all platforms."""
