"""What belongs to the measurement and not to the damper: sampling, steps, jitter, history, zeros, faults and odd records."""
