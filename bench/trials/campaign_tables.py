# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the campaign for docs/robustness.md."""

import collections
import json
import math

from judge import CRASHED, FINE, SAID, SILENT, WARNING_VERDICTS
from trial import PEER
from troubles import TROUBLES

from markdown_page import table
from systems import OURS

MUST, GOAL = "must reached", "goal reached"


class Result:
    """One drive with our record and the peer's, None when it did not run."""

    def __init__(self, drive, ours, peer):
        self.drive, self.ours, self.peer = drive, ours, peer

    @property
    def kind(self):
        return self.ours["class"]

    @property
    def is_called_doubtful(self):
        return self.kind == FINE and self.ours["verdict"] in WARNING_VERDICTS

    @property
    def peer_is_fine(self):
        return self.peer is not None and self.peer["class"] == FINE


def results(records, drives, made_with):
    """Of the drives that ours ran, with this program on this campaign."""
    ours = {r["drive"]: r for r in records if r["system"] == OURS and r["made_with"] == made_with}
    peers = {(r["drive"], r["scans"]): r for r in records if r["system"] == PEER}
    found = []
    for drive in drives:
        mine = ours.get(drive.name)
        if mine:
            found.append(Result(drive, mine, peers.get((drive.name, mine["scans"]))))
    return found


def groups(found):
    """Rows of the table: a title and the results that belong to it."""
    yield "**all**", found
    keys = {
        "trouble": lambda d: d.trouble_names or ("none",),
        "troubles": lambda d: (str(len(d.trouble_names)),),
        "world": lambda d: (d.simulation.world,),
        "sensor": lambda d: (d.simulation.sensor,),
        "start": lambda d: ("at speed" if d.start else "at rest",),
        "scans used": lambda d: ("every one" if d.every == 1 else "every second",),
    }
    for kind, of_drive in keys.items():
        parts = collections.defaultdict(list)
        for result in found:
            for name in of_drive(result.drive):
                parts[name].append(result)
        for name in sorted(parts):
            yield f"{kind}: {name}", parts[name]


def by_class(found):
    header = ["", "drives", "fine", "said", "silent", "crashed", "fine but called doubtful"]
    header += ["KISS-ICP fine"]
    rows = []
    for title, some in groups(found):
        counts = [sum(r.kind == kind for r in some) for kind in (FINE, SAID, SILENT, CRASHED)]
        doubtful = sum(r.is_called_doubtful for r in some)
        cells = [str(n) for n in (len(some), *counts, doubtful)]
        cells.append(peers_fine(some, counts[0]))
        rows.append([title, *cells])
    return table(header, rows)


def peers_fine(some, ours):
    """On how many drives the peer is fine; of those that it ran, when it did not run all."""
    fine, ran = sum(r.peer_is_fine for r in some), sum(r.peer is not None for r in some)
    text = f"{fine}" if ran == len(some) else f"{fine} of {ran}"
    return f"**{text}**" if fine > ours else text


def goals(found):
    """What must come out, as shares of all drives."""
    count = max(len(found), 1)
    fine = sum(r.kind == FINE for r in found) / count
    silent = sum(r.kind in (SILENT, CRASHED) for r in found) / count
    doubtful = sum(r.is_called_doubtful for r in found) / count
    ran = sum(r.peer is not None for r in found)
    peer = sum(r.peer_is_fine for r in found) / max(ran, 1)
    rows = [
        ["wrong and nothing said", "≤ 1 %", "0", percent(silent), reached(silent, 0.01, 0.0)],
        ["fine but called doubtful", "≤ 3 %", "≤ 1 %", percent(doubtful)]
        + [reached(doubtful, 0.03, 0.01)],
        ["fine", "≥ 90 %", "≥ 97 %", percent(fine), reached(-fine, -0.9, -0.97)],
        [f"KISS-ICP fine, of the drives that it ran on ({ran})", "", "", percent(peer), ""],
    ]
    return table(["share of the drives", "must", "goal", "measured", ""], rows)


def percent(share):
    return f"{100 * share:.1f} %"


def reached(value, must, goal):
    return GOAL if value <= goal else MUST if value <= must else "**missed**"


def silent(found, seed):
    """The drives that went wrong without a word, with what repeats each."""
    header = ["drive", "path (m)", "true (m)", "ATE (m)", "statuses", "KISS-ICP's ATE (m)"]
    header += ["figures", "again"]
    rows = []
    for result in found:
        if result.kind not in (SILENT, CRASHED):
            continue
        ours, drive = result.ours, result.drive
        statuses = ", ".join(f"{count} {name}" for name, count in ours["statuses"].items())
        if result.kind == CRASHED:
            code = ours["code"]
            statuses = "no end" if code is None else f"exit code {code}: {ours['message'][:80]}"
        numbers = [ours["path"], ours["true_path"], ours["ate"]]
        seeds = f" --seed {seed}" if seed != 1 else ""
        peer = result.peer["ate"] if result.peer else math.nan
        rows.append(
            [drive.name, *(metres(n) for n in numbers), statuses, metres(peer), figures(drive)]
            + [f"`bench/robustness{seeds} --only ^{drive.number:03d} --keep look`"]
        )
    return table(header, rows) if rows else "None."


def doubted(found):
    """The drives that were fine but called doubtful or failed, with the reasons."""
    rows = [
        [r.drive.name, metres(r.ours["ate"]), r.ours["verdict"], reasons(r.ours["reasons"])]
        for r in found
        if r.is_called_doubtful
    ]
    return table(["drive", "ATE (m)", "verdict", "reasons"], rows) if rows else "None."


def reasons(stated):
    """`verdict_reasons` of summary.json, texts or objects, for a cell."""
    texts = [one if isinstance(one, str) else json.dumps(one) for one in stated]
    return "; ".join(texts).replace("|", "/")[:300]


def troubles():
    """What each trouble is, in the words of its class."""
    rows = [[f"`{name}`", " ".join(one.__doc__.split())] for name, one in TROUBLES.items()]
    return table(["trouble", ""], rows)


def metres(value):
    return "–" if math.isnan(value) else f"{value:.2f}"


def figures(drive):
    words = [f"start {drive.start:.2f}", f"{drive.length} scans"]
    words += [f"every {drive.every}."] if drive.every > 1 else []
    if drive.simulation.is_tilted:
        words.append(f"roll {drive.simulation.roll_deg}, pitch {drive.simulation.pitch_deg} deg")
    for _, drawn in drive.troubles:
        for key, value in drawn.items():
            words.append(f"{len(value)} {key}" if isinstance(value, list) else f"{key} {value}")
    return ", ".join(words)


def summary(found):
    counts = collections.Counter(r.kind for r in found)
    doubtful = sum(r.is_called_doubtful for r in found)
    words = ", ".join(f"{counts[kind]} {kind}" for kind in (FINE, SAID, SILENT, CRASHED))
    peer = sum(r.peer_is_fine for r in found)
    return f"{len(found)} drives: {words}; {doubtful} fine but called doubtful; {PEER} fine {peer}"
