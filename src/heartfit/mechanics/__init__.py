"""The myocardium as a continuum: kinematics, laws, elements, supports, and the solver of one time step."""
