# SPDX-License-Identifier: BSD-3-Clause
"""The peers, each with its version, its settings and where they come from."""

import dataclasses

OURS = "lego-loam-sc"


@dataclasses.dataclass(frozen=True)
class Peer:
    name: str
    title: str
    requirements: tuple[str, ...]  # what pip installs, ours for reading and writing included
    settings: str  # for the document


PEERS = {
    peer.name: peer
    for peer in (
        Peer(
            "kiss-icp",
            "KISS-ICP",
            ("kiss-icp==1.3.0",),
            "the published defaults: range up to 100 m, voxels of 1 m",
        ),
        Peer(
            "kiss-slam",
            "KISS-SLAM",
            ("kiss-slam==0.0.2",),
            "the published defaults: KISS-ICP's, local maps of 100 m with voxels of 0.5 m",
        ),
        Peer(
            "genz-icp",
            "GenZ-ICP",
            ("genz-icp==0.3.2", "pyyaml==6.0.4"),
            "the files tuned by its authors: `indoor.yaml` in the car parks, the mine and the"
            " tunnel, `outdoor.yaml` in the field, `kitti.yaml` for the 64 rings; de-skewing on"
            " where points have times",
        ),
        Peer(
            "small-gicp",
            "small_gicp",
            ("small-gicp==1.0.1", "numpy==2.4.6"),
            "GICP from scan to scan with the parameters of its own odometry benchmark (voxels of"
            " 0.25 m, 10 neighbours, pairs within 1 m), started from the last motion; it cannot"
            " de-skew",
        ),
    )
}
SYSTEMS = (OURS, *PEERS)
TITLES = {OURS: "LeGO-LOAM-SC"} | {peer.name: peer.title for peer in PEERS.values()}


def genz_preset(recording):
    if recording.sensor == "rs16":
        return f"{recording.surroundings}.yaml"
    return "kitti.yaml"


def options(peer, recording):
    """What drivers/drive.py gets for one recording, but for the number of threads."""
    settings = {
        "kiss-icp": {},
        "kiss-slam": {},
        "genz-icp": {"preset": genz_preset(recording), "deskew": not recording.is_compensated},
        "small-gicp": {
            "downsampling_resolution": 0.25,
            "num_neighbors": 10,
            "max_correspondence_distance": 1.0,
        },
    }
    return {
        "settings": settings[peer],
        "deskew": not recording.is_compensated,
        "kitti": recording.sensor == "kitti",
    }
