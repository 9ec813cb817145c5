"""The FMI side of twintube: model description and documentation of the FMUs, the native kind and the Python kind."""
