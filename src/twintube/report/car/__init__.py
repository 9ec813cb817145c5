"""Pages of the whole car, of `twintube car`, and of its assumed values, of `python -m benchmarks car_sensitivity`."""
