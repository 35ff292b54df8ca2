# SPDX-License-Identifier: BSD-3-Clause
"""One process with its CPU time, ended when it takes too long."""

import dataclasses
import os
import subprocess
import threading

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


@dataclasses.dataclass(frozen=True)
class Ended:
    code: int | None  # None: it took too long
    cpu_seconds: float  # user and system, of all threads


def run(command, log, limit_s=600.0):
    """What `command` prints goes to the file `log`."""
    with log.open("w") as output:
        process = subprocess.Popen(
            [str(word) for word in command],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            env=os.environ | ONE_THREAD,
        )
        late = threading.Event()

        def end():
            late.set()
            process.kill()

        timer = threading.Timer(limit_s, end)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
    code = process.returncode = os.waitstatus_to_exitcode(status)
    return Ended(None if late.is_set() else code, usage.ru_utime + usage.ru_stime)
