"""The main job: `python -m vehicle_demo` is `twintube demo`."""
