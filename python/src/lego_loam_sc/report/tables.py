# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of a run as tables of HTML."""

from collections import Counter
from html import escape

import numpy as np

from lego_loam_sc.report.results import Results


def facts_table(results: Results) -> str:
    """What was run, on what, and what came of it."""
    scans = results.scans
    poses = results.poses
    length = float(np.linalg.norm(np.diff(poses[:, 1:4], axis=0), axis=1).sum())
    duration = float(poses[-1, 0] - poses[0, 0])
    accepted = sum(row["verdict"] == "accepted" for row in results.loops)
    rows = [
        ("scans", f"{len(scans['scan'])} in {duration:.1f} s, {_statuses(scans['status'])}"),
        ("path", f"{length:.1f} m"),
        ("key frames", f"{len(results.pose_of_key_frame)}"),
        ("loops", f"{accepted} accepted, {len(results.loops) - accepted} candidates refused"),
    ]
    if results.map is not None:
        rows.append(("map", f"{len(results.map):,} points".replace(",", " ")))
    rows += _summary_rows(results, duration)
    return _table([], rows)


def _summary_rows(results: Results, duration: float) -> list[tuple[str, str]]:
    summary = results.summary
    if summary is None:
        return [("state", "ended early; the map and the scans of loops are missing")]
    timing = summary["timing"]
    height = summary["sensor_height_m"]
    rows = [
        ("health", _health({**summary["health"], "delay": timing["delay"]})),
        ("input", "standard input" if summary["input"] == "-" else str(summary["input"])),
        ("method", f"{summary['method']}, lego-loam-sc {summary['version']}"),
        ("sensor", summary["sensor"] + (f", {height:.2f} m above the ground" if height else "")),
        (
            "time",
            f"{timing['cpu_ms_per_scan']:.1f} ms of CPU per scan, "
            f"{timing['cpu_seconds']:.1f} s of CPU and {timing['wall_seconds']:.1f} s of wall time "
            f"for a drive of {duration:.1f} s",
        ),
        ("memory", f"{timing['peak_memory_mb']:.0f} MiB"),
        (
            "machine",
            f"{timing['processor'] or 'processor of unknown name'}, "
            f"{_number(timing['processors'], 'processor')}, "
            f"at most {_number(timing['threads'], 'thread')} used",
        ),
    ]
    if summary["interrupted"]:
        rows.append(("state", "interrupted; the results are of the scans before that"))
    rows += [("fault", fault) for fault in summary["faults"]]
    return rows


def _number(count: int, what: str) -> str:
    return f"{count} {what}" + ("" if count == 1 else "s")


def _statuses(status: np.ndarray) -> str:
    counts = Counter(map(str, status)).most_common()
    if [name for name, _ in counts] == ["ok"]:
        return "all ok"
    return ", ".join(f"{count} {name}" for name, count in counts)


def _health(vitals: dict[str, dict]) -> str:
    """How many scans were at a warning or an error level, for the values that reached one."""
    parts = []
    for name, vital in vitals.items():
        if vital["warnings"] + vital["errors"] > 0:
            parts.append(f"{name}: {vital['warnings']} warnings, {vital['errors']} errors")
    return "; ".join(parts) or "no value reached a warning level"


_ERRORS = (
    ("ATE, RMSE", "m", ("ate_m", "rmse"), 4),
    ("ATE, maximum", "m", ("ate_m", "max"), 4),
    ("ATE without alignment, RMSE", "m", ("ate_unaligned_m", "rmse"), 4),
    ("RPE from scan to scan, translation, RMSE", "m", ("rpe_frame", "translation_m", "rmse"), 4),
    ("RPE from scan to scan, rotation, RMSE", "°", ("rpe_frame", "rotation_deg", "rmse"), 4),
    ("RPE over one metre, translation, RMSE", "m", ("rpe_metre", "translation_m", "rmse"), 4),
    ("RPE over one metre, rotation, RMSE", "°", ("rpe_metre", "rotation_deg", "rmse"), 4),
    ("KITTI <i>t</i><sub>rel</sub>", "%", ("kitti", "t_rel_percent"), 3),
    ("KITTI <i>r</i><sub>rel</sub>", "°/100 m", ("kitti", "r_rel_deg_per_100m"), 3),
    ("error at the end, x", "m", ("end", "x_m"), 4),
    ("error at the end, y", "m", ("end", "y_m"), 4),
    ("error at the end, z", "m", ("end", "z_m"), 4),
    ("error at the end, rotation", "°", ("end", "rotation_deg"), 3),
    ("path length", "m", ("estimate_length_m",), 2),
)


def error_table(results: Results) -> str:
    """The errors against the truth, or an empty text."""
    errors = (results.summary or {}).get("errors")
    if not errors:
        return ""
    rows = []
    for name, unit, path, decimals in _ERRORS:
        values = [_find(errors[which], path) for which in ("trajectory", "odometry")]
        if values[0] is not None:
            rows.append((f"{name} ({unit})", *(f"{value:.{decimals}f}" for value in values)))
    truth = errors["trajectory"]
    rows.append(("path length of the truth (m)", f"{truth['truth_length_m']:.2f}", ""))
    head = ["", "after loops", "before loops"]
    return (
        "<h2>Errors against the truth</h2>"
        + _table(head, rows, "numbers", names_are_html=True)
        + f"<p class=note>{truth['pairs']} poses compared with {escape(errors['truth'])}.</p>"
    )


def _find(errors: dict, path: tuple[str, ...]) -> float | None:
    for key in path:
        if errors is None:
            return None
        errors = errors[key]
    return errors


def _table(head: list[str], rows: list[tuple], kind: str = "", names_are_html: bool = False) -> str:
    cells = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    lines = [f"<thead><tr>{cells}</tr></thead>" if head else ""]
    for name, *values in rows:
        label = name if names_are_html else escape(name)
        cells = "".join(f"<td>{escape(value)}</td>" for value in values)
        lines.append(f"<tr><th>{label}</th>{cells}</tr>")
    return f'<table class="{kind}">{"".join(lines)}</table>'
