"""What each integrator does with stiff and extreme scenes: where it is accurate, stable, or breaks."""
