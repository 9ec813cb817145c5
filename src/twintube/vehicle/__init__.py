"""Vehicle: road, quarter car, manoeuvres of Table 3, rides."""
