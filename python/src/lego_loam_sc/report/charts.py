# SPDX-License-Identifier: BSD-3-Clause
"""What happened over time: height, speed, degeneracy and the time that each stage took."""

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from lego_loam_sc.report.results import Results

BEFORE, AFTER = "#d9480f", "#1a1a1a"  # the trajectory before and after loops, as in the map
_STAGES = {
    "projection": "#bdd7e7",
    "segmentation": "#6baed6",
    "features": "#2171b5",
    "odometry": "#74c476",
    "mapping": "#238b45",
    "loops": "#d94801",
}
_TITLES = (
    "Height",
    "Speed",
    "Constraints on the weakest direction of the scan-to-map match",
    "Time of each stage",
)


def make_charts(results: Results) -> str:
    """A plotly figure as JSON."""
    figure = make_subplots(
        rows=4, shared_xaxes=True, vertical_spacing=0.055, subplot_titles=_TITLES
    )
    _add_height(figure, results)
    _add_speed(figure, results)
    _add_degeneracy(figure, results)
    _add_stages(figure, results)
    font = "Charter, 'Bitstream Charter', 'Source Serif 4', Georgia, serif"
    figure.update_layout(
        height=980,
        margin={"l": 70, "r": 170, "t": 30, "b": 50},
        font={"family": font, "size": 13, "color": "#222"},
        paper_bgcolor="white",
        plot_bgcolor="white",
        hovermode="x",
        hoverlabel={"font": {"family": font}},
    )
    figure.update_annotations(x=0, xanchor="left", font={"size": 14})
    axis = {
        "showline": True,
        "linecolor": "#222",
        "ticks": "outside",
        "gridcolor": "#e8e8e8",
        "zeroline": False,
    }
    figure.update_xaxes(**axis, showspikes=True, spikethickness=1, spikecolor="#999")
    figure.update_yaxes(**axis)
    figure.update_xaxes(title_text="time since the first scan (s)", row=4)
    for row in range(1, 5):
        top = figure.layout[f"yaxis{row if row > 1 else ''}"].domain[1]
        name = f"legend{row if row > 1 else ''}"
        figure.update_layout({name: {"y": top, "yanchor": "top", "x": 1.01}})
        figure.update_traces(legend=name, row=row)
    return figure.to_json()


def _short(values: np.ndarray) -> np.ndarray:
    return values.astype(np.float32)


def _line(times: np.ndarray, values: np.ndarray, name: str, colour: str, unit: str) -> go.Scatter:
    return go.Scatter(
        x=_short(times),
        y=_short(values),
        name=name,
        line={"color": colour, "width": 1.4},
        hovertemplate=f"%{{y:.2f}} {unit}",
    )


def _add_height(figure: go.Figure, results: Results) -> None:
    time = results.odometry[:, 0] - results.start
    after = _line(time, results.poses[:, 3], "after loops", AFTER, "m")
    if results.corrected:
        before = _line(time, results.odometry[:, 3], "before loops", BEFORE, "m")
        figure.add_trace(before, row=1, col=1)
    figure.add_trace(after.update(showlegend=results.corrected), row=1, col=1)
    figure.update_yaxes(title_text="z (m)", row=1)


def _add_speed(figure: go.Figure, results: Results) -> None:
    """Of the live poses: a loop's correction between two scans is no motion."""
    poses = results.odometry
    if len(poses) > 1:
        seconds = np.diff(poses[:, 0])
        speed = np.linalg.norm(np.diff(poses[:, 1:4], axis=0), axis=1) / seconds
        middle = poses[:-1, 0] + seconds / 2 - results.start
        line = _line(middle, speed, "speed", AFTER, "m/s")
        figure.add_trace(line.update(showlegend=False), row=2, col=1)
    figure.update_yaxes(title_text="speed (m/s)", rangemode="tozero", row=2)


def _add_degeneracy(figure: go.Figure, results: Results) -> None:
    scans = results.scans
    time = scans["stamp"] - results.start
    matched = scans["map_matches"] > 0
    strengths = {}
    for name, colour in (("translation", "#2171b5"), ("rotation", "#238b45")):
        # A logarithm has no zero.
        strength = np.where(matched, np.maximum(scans[f"{name}_strength"], 0.1), np.nan)
        strengths[name] = strength
        figure.add_trace(_line(time, strength, name, colour, "constraints"), row=3, col=1)
    degenerate = (scans["degenerate_translations"] > 0) | (scans["degenerate_rotations"] > 0)
    weakest = np.fmin(strengths["translation"], strengths["rotation"])
    bad = ~np.isin(scans["status"], ("ok", "degenerate"))
    for name, colour, symbol, where in (
        ("degenerate", "#d9480f", "circle-open", degenerate),
        ("not matched", "#c92a2a", "x", bad),
    ):
        if not where.any():
            continue
        figure.add_trace(
            go.Scatter(
                x=_short(time[where]),
                y=_short(np.where(np.isnan(weakest), 0.1, weakest)[where]),
                mode="markers",
                name=name,
                marker={"color": colour, "symbol": symbol, "size": 6},
                text=scans["status"][where],
                hovertemplate="%{text}",
            ),
            row=3,
            col=1,
        )
    figure.update_yaxes(title_text="constraints", type="log", dtick="D2", row=3)


def _add_stages(figure: go.Figure, results: Results) -> None:
    time = results.scans["stamp"] - results.start
    for name, colour in _STAGES.items():
        figure.add_trace(
            go.Scatter(
                x=_short(time),
                y=_short(results.scans[f"{name}_ms"]),
                name=name,
                stackgroup="stages",
                line={"width": 0},
                fillcolor=colour,
                hovertemplate="%{y:.1f} ms",
            ),
            row=4,
            col=1,
        )
    total = sum(results.scans[f"{name}_ms"] for name in _STAGES)
    # One slow scan must not flatten the others.
    top = max(1.6 * float(np.quantile(total, 0.98)), 1.0)
    figure.update_yaxes(title_text="wall time (ms)", range=[0, min(top, 1.05 * total.max())], row=4)
