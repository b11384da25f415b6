"""Shared by all Python tests: one thread per process, and a loud word about what was skipped."""

from __future__ import annotations

import os

# Before NumPy is loaded: many small solves are slower on several threads.
for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")
