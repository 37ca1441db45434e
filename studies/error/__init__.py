"""Error against run time: how far a step, a mesh and a quadrature are from converged, and what they cost."""
