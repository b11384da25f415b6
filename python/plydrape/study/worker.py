"""A worker process: takes runs of scenarios from standard input, gives rows to standard output.

Both are streams of pickles. A worker is a plain process of the same Python, not one of
`multiprocessing`, for three reasons: it does not run the caller's main script again, it is known
which run of scenarios a dead one had, and it ends by itself when its client is gone.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
from typing import Any

READY = "ready"

# One thread for each process, whatever is inside.
THREADS = dict.fromkeys(
    ("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"
)

# How the client starts a worker; behind it stand the folders of `sys.path`.
START = "import sys; sys.path[:] = sys.argv[1:]; from plydrape.study.worker import main; main()"


def main() -> None:
    """Works until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # What a library prints goes to standard error, not between the rows.
    results = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    jobs = sys.stdin.buffer

    def answer(what: Any) -> None:
        results.write(pickle.dumps(what))
        results.flush()

    try:
        task = pickle.load(jobs)
        answer(READY)
        while True:
            first, values = pickle.load(jobs)
            try:
                answer(task.batch(first, values))
            except Exception as error:
                answer(error)
    except (EOFError, BrokenPipeError):
        # The client is done, or gone.
        os._exit(0)
