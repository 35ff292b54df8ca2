# SPDX-License-Identifier: BSD-3-Clause
"""Puts the page together: template, libraries and data in one file."""

import json
from html import escape
from importlib.resources import files

import jupyter_threejs_sage
import plotly.offline

from lego_loam_sc.report import geometry
from lego_loam_sc.report.charts import make_charts
from lego_loam_sc.report.results import Results
from lego_loam_sc.report.tables import error_table, facts_table

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
        "STYLE": _asset("page.css"),
        "FACTS": facts_table(results),
        "ERRORS": error_table(results),
        "SETTINGS": escape(results.settings),
        "SENSOR": escape(results.sensor),
        "DATA": _inside_script(json.dumps(data, separators=(",", ":"))),
        "PLOTLY": _inside_script(plotly.offline.get_plotlyjs()),
        "THREE": _inside_script(files(jupyter_threejs_sage).joinpath(_THREE).read_text()),
        "SCRIPT": _asset("colours.js") + _asset("views.js") + _asset("page.js"),
    }
    # Cut at the places first: what is put in may look like one.
    pieces = _asset("page.html").split("%%")
    return "".join(parts[piece] if k % 2 else piece for k, piece in enumerate(pieces))


def _title(results: Results) -> str:
    if results.summary is None:
        return f"{results.folder.resolve().name} (broken off)"
    name = str(results.summary["input"]).rstrip("/").rsplit("/", 1)[-1]
    return "scan stream" if name == "-" else name


def _asset(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def _inside_script(text: str) -> str:
    """The same to JavaScript, and no end of a script to HTML."""
    return text.replace("</", "<\\/").replace("<!--", "<\\!--")
