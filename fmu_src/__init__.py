"""What goes into an FMU and is not the model: C sources, the Python kind's script, a picture."""
