# SPDX-License-Identifier: BSD-3-Clause
"""One look for all figures."""

import io

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  the backend must be chosen first
from PIL import Image  # noqa: E402

# Okabe and Ito's colours, told apart by the colour-blind too.
COLOURS = {
    "truth": "#000000",
    "loam": "#e69f00",
    "lego-loam": "#0072b2",
    "lego-loam-sc-paper": "#cc79a7",
    "lego-loam-sc": "#009e73",
}
NAMES = {
    "truth": "truth",
    "loam": "LOAM",
    "lego-loam": "LeGO-LOAM",
    "lego-loam-sc-paper": "LeGO-LOAM-SC, as in the paper",
    "lego-loam-sc": "LeGO-LOAM-SC",
}
FRAME = "#d00000"
DPI = 140
PALETTE = 128

plt.rcParams.update(
    {
        "font.size": 9,
        "axes.titlesize": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.linewidth": 0.6,
        "lines.linewidth": 1.2,
        "legend.frameon": False,
        "figure.constrained_layout.use": True,
    }
)


def figure(columns, rows=1, panel=(4.2, 4.2), **options):
    """A figure and its axes, always a list in reading order; `panel` is one's size in inches."""
    size = (columns * panel[0], rows * panel[1])
    result, axes = plt.subplots(rows, columns, figsize=size, squeeze=False, **options)
    return result, list(axes.flat)


def from_above(axes, title, extent=None):
    """Makes `axes` a plan in metres; `extent` is (left, right, bottom, top)."""
    axes.set_title(title)
    axes.set_aspect("equal")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    if extent:
        axes.set_xlim(extent[:2])
        axes.set_ylim(extent[2:])


def frame(axes, extent):
    """The red box around the start and the end."""
    left, right, bottom, top = extent
    box = plt.Rectangle((left, bottom), right - left, top - bottom, fill=False, ec=FRAME, lw=1.4)
    axes.add_patch(box)


def save(result, path):
    """Writes a PNG with a palette, which is a third of the size of one in full colour."""
    buffer = io.BytesIO()
    result.savefig(buffer, dpi=DPI, format="png", bbox_inches="tight")
    plt.close(result)
    picture = Image.open(buffer).convert("RGB")
    palette = picture.quantize(PALETTE, Image.Quantize.MAXCOVERAGE, 3, dither=Image.Dither.NONE)
    path.parent.mkdir(parents=True, exist_ok=True)
    palette.save(path, optimize=True)
