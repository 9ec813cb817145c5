"""What identification and diagnosis both need to compare the model with records.

    harmonic        a harmonic record with its oscillations marked
    oscillations    where oscillations begin and end, rests, velocities from the stroke
    averaging       a force channel that was smoothed after the measurement
    intervals       mean forces over intervals
    simulation      simulated mean forces over the intervals of many records, on all cores
    parameters      the fourteen degradation parameters and their ranges
    least_squares   least squares in parameters scaled to their ranges, derivatives, sandwich estimate
    splits          distinct velocities
    journal         values of a search that survive a killed run

It imports from core, dampers, engine and data only.
"""
