"""Many drapes or equilibria in one call, on all cores."""

from plydrape._plydrape import Equilibria, equilibria
from plydrape._plydrape import simulate_all as simulate

__all__ = ["Equilibria", "equilibria", "simulate"]
