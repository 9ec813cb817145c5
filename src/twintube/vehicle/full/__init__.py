"""The whole car: body, four wheels with tyres, four dampers, brakes."""
