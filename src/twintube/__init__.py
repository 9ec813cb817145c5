"""Semi-physical model of a twin-tube shock absorber that has lost oil and gas."""

__version__ = "0.1.0"
