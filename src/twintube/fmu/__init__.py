"""FMI: model description and documentation of the FMUs, the native kind and the Python kind, parameter sets as SSV."""

from twintube.fmu.assemble import BuildError, build_fmu

__all__ = ["BuildError", "build_fmu"]
