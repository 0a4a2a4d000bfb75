"""The bearing at rest: equilibrium, stiffness maps, what a load asks of the contacts."""
