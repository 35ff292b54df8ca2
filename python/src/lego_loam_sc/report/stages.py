# SPDX-License-Identifier: BSD-3-Clause
"""The page of one scan: the range image in the colours of each stage of the front end."""

from html import escape
from pathlib import Path

import numpy as np

from lego_loam_sc.report.ply import positions_of, read_ply
from lego_loam_sc.report.results import read_json
from lego_loam_sc.report.template import asset, fill, to_script

FACTS = "stages.json"  # in what inspect leaves


def make_stage_page(folder: Path) -> str:
    """The page as text."""
    facts = read_json(folder / FACTS)
    points = read_ply(folder / "rows.ply")  # each cloud has all that is known of each point
    data = {key: facts[key] for key in ("rows", "columns", "elevation_deg")}
    data["points"] = np.bincount(points["row"], minlength=facts["rows"]).tolist()
    parts = {
        "TITLE": escape(Path(facts["input"]).name),
        "STYLE": asset("page.css") + asset("stages.css"),
        "SUMMARY": escape(f"{facts['input']}\n\n{facts['summary']}"),
        "DATA": to_script(
            data | _layers(points, facts["rows"] * facts["columns"], facts["columns"])
        ),
        "SCRIPT": asset("stages.js"),
    }
    return fill("stages.html", parts)


def _layers(points: np.ndarray, pixels: int, columns: int) -> dict[str, list]:
    """For each pixel, row by row from the lowest, what is known of its nearest point; None where
    nothing was seen or the value is not defined."""
    ranges = np.linalg.norm(positions_of(points), axis=1)
    order = np.argsort(-ranges, kind="stable")  # the nearest is written last
    nearest = np.full(pixels, -1)
    nearest[points["row"][order] * columns + points["column"][order]] = order

    def layer(values: np.ndarray) -> list:
        defined = (nearest >= 0) & np.isfinite(values)[nearest]
        return [
            int(values[k]) if there else None for k, there in zip(nearest, defined, strict=True)
        ]

    def thousandths(values: np.ndarray) -> list:  # which are short to write
        return layer(np.round(1000 * values))

    return {
        "range": thousandths(ranges),
        "intensity": thousandths(points["intensity"]),
        "ground": layer(points["ground"]),
        "cluster": layer(points["cluster"]),
        "sharpness": thousandths(points["sharpness"]),
        "feature": layer(points["feature"]),
    }
