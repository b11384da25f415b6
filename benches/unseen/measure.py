"""Runs a program and writes its exit code, its time and its memory to a file.

    python -I -S measure.py REPORT TIMEOUT GRACE COMMAND...

This is a process of its own because of the memory. Linux counts to the peak memory of a process
what the process that started it held at that moment, also after the program is loaded. So a program
that a large Python starts seems to need as much as that Python. This one holds some 10 MB, which is
then the least that can be measured.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time


def main(report: str, timeout: float, grace: float, command: list[str]) -> None:
    """Tells the program to end after `timeout`, and kills it `grace` later (s)."""
    begin = time.perf_counter()
    child = subprocess.Popen(command)
    late = threading.Event()

    def end(sign: signal.Signals) -> None:
        late.set()
        os.kill(child.pid, sign)

    timers = [
        threading.Timer(timeout, end, [signal.SIGTERM]),
        threading.Timer(timeout + grace, end, [signal.SIGKILL]),
    ]
    for timer in timers:
        timer.start()
    try:
        _, status, usage = os.wait4(child.pid, 0)
    finally:
        for timer in timers:
            timer.cancel()
    seconds = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    # Linux counts in KiB, macOS in bytes
    unit = 1 if sys.platform == "darwin" else 1024
    measured = {
        "exit": child.returncode,
        "late": late.is_set(),
        "seconds": seconds,
        "memory_mb": usage.ru_maxrss * unit / 1e6,
    }
    with open(report, "w", encoding="utf-8") as file:
        json.dump(measured, file)


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), sys.argv[4:])
