# SPDX-License-Identifier: BSD-3-Clause
"""What must come out of the comparison, and what did."""

import math

from markdown_page import table
from systems import TITLES

REACHED, ENOUGH, MISSED = "goal reached", "must reached", "**missed**"
SIXTEEN, SIXTY_FOUR = (8.0, 4.0), (25.0, 12.0)  # ms of CPU per scan
FASTER = (3.0, 6.0)
SLOW = (100.0, 50.0)  # ms, what 99.9 % of the scans stay below
KITTI_04 = (0.03, 0.02)  # m


def verdict(must, goal):
    return REACHED if goal else ENOUGH if must else MISSED


def cpu(one):
    must, goal = SIXTEEN if one.recording.rings == 16 else SIXTY_FOUR
    value = one.ours.cpu_ms
    limits = [f"≤ {must:.0f} ms", f"≤ {goal:.0f} ms"]
    return [["CPU per scan", *limits, f"{value:.1f} ms", verdict(value <= must, value <= goal)]]


def against_kiss(one):
    peer = one.peers.get("kiss-icp")
    if peer is None:
        return []
    value = peer.cpu_ms / one.ours.cpu_ms
    limits = [f"{limit:.0f} times less" for limit in FASTER]
    words = verdict(value >= FASTER[0], value >= FASTER[1])
    return [["CPU against KISS-ICP", *limits, f"{value:.1f} times less", words]]


def accuracy(one):
    best = one.best_peer(lambda result: result.ate)
    if best is None or math.isnan(one.ours.ate):
        return []
    name, value = best
    measured = f"{one.ours.ate:.3f} m, {TITLES[name]} {value:.3f} m"
    words = verdict(one.ours.ate <= value, one.ours.ate <= 0.5 * value)
    rows = [["ATE against the best peer", "not worse", "half of it", measured, words]]
    if one.name == "kitti_odometry_04":
        limits = [f"≤ {limit} m" for limit in KITTI_04]
        words = verdict(*(one.ours.ate <= limit for limit in KITTI_04))
        rows.append(["ATE", *limits, f"{one.ours.ate:.4f} m", words])
    return rows


def slow_scans(one):
    value = one.ours.slow_ms
    if math.isnan(value) or one.ours.scans < 1000:
        return []
    limits = [f"≤ {limit:.0f} ms" for limit in SLOW]
    words = verdict(*(value <= limit for limit in SLOW))
    return [["99.9 % of the scans", *limits, f"{value:.0f} ms", words]]


def goals_table(compared):
    rows = []
    for one in compared:
        if one.ours:
            for row in cpu(one) + slow_scans(one) + against_kiss(one) + accuracy(one):
                rows.append([f"`{one.name}`", *row])
    return table(["input", "what", "must", "goal", "measured", ""], rows)
