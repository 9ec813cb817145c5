"""The explorer: one HTML page that runs the damper of the native FMU as WebAssembly."""
