"""The bearing at rest: equilibrium, stiffness maps, pressure, film and life of the contacts."""
