# SPDX-License-Identifier: BSD-3-Clause
"""One process, alone: CPU time, wall time and memory as the kernel counts them."""

import dataclasses
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time


@dataclasses.dataclass(frozen=True)
class Usage:
    cpu_seconds: float  # user and system, of all threads
    wall_seconds: float
    peak_mib: float  # of the resident set
    others: float  # share of the machine's CPU time that other processes had meanwhile


class ProcessError(Exception):
    """What a process printed before it failed."""


def busy_seconds():
    """CPU time of all processes since the machine's start, and that of the hosts of the machine."""
    user, nice, system, _, _, *interrupts_and_stolen = [
        int(ticks) for ticks in pathlib.Path("/proc/stat").read_text().split("\n")[0].split()[1:9]
    ]
    return (user + nice + system + sum(interrupts_and_stolen)) / os.sysconf("SC_CLK_TCK")


def run(command, threads, log):
    """Runs `command` on as many of the machine's cores as it has threads; its output goes to `log`.

    Not every peer can be told how many threads to take, but all take no more than the cores that
    they are given. A small process starts it: the kernel counts the largest resident set from that
    of the starting process on.
    """
    cores = sorted(os.sched_getaffinity(0))[:threads]
    with log.open("w") as output, tempfile.NamedTemporaryFile() as record:
        starter = [sys.executable, __file__, record.name, json.dumps(cores)]
        subprocess.run(
            [*starter, *(str(word) for word in command)],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            check=True,
        )
        result = json.load(record)
    if result["code"] != 0:
        raise ProcessError(f"exit code {result['code']}: {log.read_text()[-2000:].strip()}")
    return Usage(**result["usage"])


def start(record, cores, *command):
    """The small process: writes the exit code and the usage of `command` to the file `record`."""
    os.sched_setaffinity(0, json.loads(cores))
    begin, busy = time.monotonic(), busy_seconds()
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    wall, busy = time.monotonic() - begin, busy_seconds() - busy
    code = process.returncode = os.waitstatus_to_exitcode(status)
    cpu = usage.ru_utime + usage.ru_stime
    others = max(0.0, busy - cpu) / (wall * os.cpu_count())
    result = Usage(cpu, wall, usage.ru_maxrss / 1024, others)
    text = json.dumps({"code": code, "usage": dataclasses.asdict(result)})
    pathlib.Path(record).write_text(text)


if __name__ == "__main__":
    start(*sys.argv[1:])
