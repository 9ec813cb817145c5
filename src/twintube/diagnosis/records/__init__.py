"""Records as they are compared: thinned, with their noise, and the forces as the channels see them."""
