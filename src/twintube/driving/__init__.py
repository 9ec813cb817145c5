"""The driving car: its signals as the bus shows them, and drives of cars with worn dampers."""
