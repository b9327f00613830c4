"""The paper's solver: the lattice stepped through time, on a fixed or an adaptive grid."""
