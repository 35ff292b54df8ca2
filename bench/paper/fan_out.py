# SPDX-License-Identifier: BSD-3-Clause
"""One process writes, several read the same bytes: tee, for streams that are too big for a disk."""

import fcntl
import subprocess

BLOCK = 1 << 20  # bytes, the largest pipe that Linux gives to everybody


def start(command, log, **pipes):
    return subprocess.Popen([str(word) for word in command], stderr=log, **pipes)


def copy(source, sinks):
    """Until the end of `source`; the slowest of the sinks holds the others back."""
    for pipe in (source, *sinks):
        fcntl.fcntl(pipe, fcntl.F_SETPIPE_SZ, BLOCK)
    while block := source.read(BLOCK):
        for sink in sinks:
            sink.write(block)
    for sink in sinks:
        sink.close()


def fan_out(source, sinks, folder):
    """Runs the commands until all have ended; returns a sentence about what failed, or None.

    Each error output goes to a file in `folder`, which is quoted when that process fails.
    """
    commands = [source, *sinks]
    logs = [folder / f"stderr-{index}.txt" for index in range(len(commands))]
    opened = [log.open("w") for log in logs]
    writer = start(source, opened[0], stdout=subprocess.PIPE)
    readers = [
        start(sink, log, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL)
        for sink, log in zip(sinks, opened[1:], strict=True)
    ]
    try:
        copy(writer.stdout, [reader.stdin for reader in readers])
    except BrokenPipeError:  # one of the readers has ended, its exit code tells why
        for process in (writer, *readers):
            process.terminate()
    codes = [process.wait() for process in (writer, *readers)]
    for log in opened:
        log.close()
    return first_fault(commands, codes, logs)


def first_fault(commands, codes, logs):
    """Exit codes above zero come before the signals that ended the others on their account."""
    for code, command, log in sorted(
        zip(codes, commands, logs, strict=True), key=lambda item: -item[0]
    ):
        if code != 0:
            return f"{' '.join(map(str, command))}: exit code {code}: {log.read_text().strip()}"
    return None
