# SPDX-License-Identifier: BSD-3-Clause
"""The page of a run: template, libraries and data in one file."""

import json
from html import escape
from importlib.resources import files

import jupyter_threejs_sage
import plotly.offline

from lego_loam_sc.report import geometry
from lego_loam_sc.report.charts import make_charts
from lego_loam_sc.report.results import Results
from lego_loam_sc.report.tables import error_table, facts_table
from lego_loam_sc.report.template import asset, fill, inside_script, to_script

_THREE = "static/r130/three.min.js"


def make_page(results: Results, most_points: int) -> str:
    """The page as text. `most_points` of the map are in it."""
    data = {
        "scene": geometry.scene(results, most_points),
        "loops": geometry.loops(results),
        "clouds": geometry.loop_clouds(results),
        "charts": json.loads(make_charts(results)),
    }
    parts = {
        "TITLE": escape(_title(results)),
        "STYLE": asset("page.css"),
        "FACTS": facts_table(results),
        "ERRORS": error_table(results),
        "SETTINGS": escape(results.settings),
        "SENSOR": escape(results.sensor),
        "DATA": to_script(data),
        "PLOTLY": inside_script(plotly.offline.get_plotlyjs()),
        "THREE": inside_script(files(jupyter_threejs_sage).joinpath(_THREE).read_text()),
        "SCRIPT": asset("colours.js") + asset("views.js") + asset("page.js"),
    }
    return fill("page.html", parts)


def _title(results: Results) -> str:
    if results.summary is None:
        return f"{results.folder.resolve().name} (ended early)"
    name = str(results.summary["input"]).rstrip("/").rsplit("/", 1)[-1]
    return "scan stream" if name == "-" else name
