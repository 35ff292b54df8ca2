"""One process, alone: CPU time, wall time and memory as the kernel counts them."""

import dataclasses
import os
import subprocess
import time


@dataclasses.dataclass(frozen=True)
class Usage:
    cpu_seconds: float  # user and system, of all threads
    wall_seconds: float
    peak_mib: float  # of the resident set


class ProcessError(Exception):
    """What a process printed before it failed."""


def run(command, threads, log):
    """Runs `command` on as many of the machine's cores as it has threads; its output goes to `log`.

    Not every peer can be told how many threads to take, but all take no more than the cores that
    they are given.
    """
    cores = sorted(os.sched_getaffinity(0))[:threads]
    with log.open("w") as output:
        begin = time.monotonic()
        process = subprocess.Popen(
            [str(word) for word in command],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            preexec_fn=lambda: os.sched_setaffinity(0, cores),
        )
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - begin
    code = process.returncode = os.waitstatus_to_exitcode(status)
    if code != 0:
        raise ProcessError(f"exit code {code}: {log.read_text()[-2000:].strip()}")
    return Usage(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024)
