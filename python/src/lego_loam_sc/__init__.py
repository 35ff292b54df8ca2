# SPDX-License-Identifier: BSD-3-Clause
"""LeGO-LOAM-SC: the SLAM itself (the names below) and readers of recordings."""

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lego_loam_sc._core import *

__all__ = [
    "InputError",
    "Scan",
    "ScanContext",
    "ScanContextSettings",
    "SensorModel",
    "Settings",
    "Slam",
    "Status",
    "Verdict",
    "load_sensor",
    "load_settings",
    "match",
    "open_scans",
    "recognise_sensor",
]


def __getattr__(name: str):
    """Loads the compiled part when it is first asked for: the readers do without."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        core = importlib.import_module("lego_loam_sc._core")
    except ModuleNotFoundError:
        raise ImportError(
            f"lego_loam_sc.{name} is compiled, and here the readers alone are installed; "
            "run pip install . in the repository without LEGO_LOAM_SC_READERS_ONLY"
        ) from None
    return getattr(core, name)
