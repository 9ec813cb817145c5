"""The car around the damper: road, quarter car, manoeuvres, rides."""
