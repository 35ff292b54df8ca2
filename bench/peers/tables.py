# SPDX-License-Identifier: BSD-3-Clause
"""Tables of docs/peers.md."""

import math

from stages import STAGES

from markdown_page import fixed, table
from systems import OURS, PEERS, SYSTEMS, TITLES


def ratios(compared, value):
    """Each peer's value over ours; where the peer is better, in bold."""
    header = ["input", *(TITLES[name] for name in PEERS)]
    rows = []
    for one in compared:
        if not one.ours or not one.peers or math.isnan(value(one.ours)):
            continue
        cells = [ratio(one.peers.get(name), one.ours, value) for name in PEERS]
        rows.append([f"`{one.name}`", *cells])
    return table(header, rows)


def ratio(peer, ours, value):
    if peer is None:
        return ""
    quotient = value(peer) / value(ours)
    text = f"{quotient:.2f}" if quotient < 10 else f"{quotient:.0f}"
    return f"**{text}**" if quotient < 1 else text


def absolute(one):
    """All figures of one input."""
    header = ["", "CPU (ms)", "wall, 1 thread (ms)", "wall, 2 threads (ms)", "memory (MiB)"]
    header += ["ATE RMSE (m)", "ATE maximum (m)", "RPE (m)", "t_rel (%)", "others (%)"]
    rows = []
    for name in SYSTEMS:
        run, both = one.main.get(name), one.runs[2].get(name)
        if run is None:
            continue
        walls = fixed((run.wall_ms, both.wall_ms if both else math.nan), 1)
        figures = fixed((run.ate, run.ate_max, run.rpe), 4) + fixed((run.t_rel,), 2)
        figures += fixed((run.others,), 0)
        title = f"**{TITLES[name]}**" if name == OURS else TITLES[name]
        rows.append([title, f"{run.cpu_ms:.1f}", *walls, f"{run.peak_mib:.0f}", *figures])
    return table(header, rows)


def absolutes(compared):
    parts = []
    for one in compared:
        if one.main:
            scans = max(run.scans for run in one.main.values())
            parts.append(f"### `{one.name}`: {scans} scans, {one.recording.rings} rings")
            parts.append(absolute(one))
    return "\n\n".join(parts)


def stages(compared):
    """Of ours, by the clock; the rest of the time is for reading and writing."""
    rows = []
    for one in compared:
        if one.ours and one.ours.stages:
            means = [one.ours.stages[stage] for stage in STAGES]
            rest = one.ours.wall_ms - sum(means)
            rows.append([f"`{one.name}`", *fixed((*means, rest, one.ours.slow_ms), 1)])
    return table(["input", *STAGES, "read, write", "99.9 % of the scans"], rows)


def settings():
    rows = [[peer.title, f"`{peer.requirements[0]}`", peer.settings] for peer in PEERS.values()]
    return table(["peer", "package", "settings"], rows)
