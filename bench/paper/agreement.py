# SPDX-License-Identifier: BSD-3-Clause
"""Does `lego-loam-sc evaluate` say what evo says?"""

import math

EVO_DIGITS = 6  # that evo prints of an error; of a length it prints 3
LENGTH_DIGITS = 3


def values(run):
    """(what, evaluate's value, evo's value, digits) of one run; evaluate has no minimum."""
    evaluation = run.evaluation
    pairs = [("path length", evaluation["estimate_length_m"], run.length, LENGTH_DIGITS)]
    for name, ours, evo in (
        ("ATE", evaluation["ate_m"], run.ate),
        ("RPE", evaluation["rpe_frame"]["translation_m"], run.rpe),
    ):
        for key in ("max", "min", "rmse"):
            if key in ours and not math.isnan(evo[key]):
                pairs.append((f"{name} {key}", ours[key], evo[key], EVO_DIGITS))
    return pairs


def sentence(worlds):
    """How many values agree to evo's last printed digit, and those that do not."""
    checked, differing = 0, []
    for world in worlds:
        for method, run in world.runs.items():
            for what, ours, evo, digits in values(run):
                checked += 1
                if f"{ours:.{digits}f}" != f"{evo:.{digits}f}":
                    differing.append(f"{what} of `{method}` on `{world.name}` ({ours} and {evo})")
    if not differing:
        return f"it agrees with evo to the last digit that evo prints, in all {checked} values."
    return f"of {checked} values these differ from evo's: {'; '.join(differing)}."
