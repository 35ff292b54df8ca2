# SPDX-License-Identifier: BSD-3-Clause
"""Velodyne captures, made here packet by packet as the VLP-16 manual lays them out."""

import struct

import numpy as np
import pytest

BLOCK_S = 2 * 55.296e-6  # two firing sequences
BLOCK_DEG = 0.4
RANGE_M = 12.0
ELEVATIONS_DEG = np.arange(-15, 16, 2)
TURNS = 3


def vlp16_packet(block, start_us):
    """A data packet from block number `block` on: every beam returns from RANGE_M."""
    payload = b""
    for k in range(block, block + 12):
        azimuth = round(k * BLOCK_DEG * 100) % 36000
        payload += b"\xff\xee" + struct.pack("<H", azimuth)
        payload += struct.pack("<HB", round(RANGE_M / 0.002), 80) * 32
    microseconds = round(start_us + block * BLOCK_S * 1e6)
    return payload + struct.pack("<IBB", microseconds, 0x37, 0x22)


def frame(payload):
    """Ethernet, IPv4 and UDP around a payload."""
    udp = struct.pack(">HHHH", 2368, 2368, 8 + len(payload), 0)
    ip = struct.pack(
        ">BBHHHBBH4s4s",
        0x45,
        0,
        28 + len(payload),
        0,
        0,
        64,
        17,
        0,
        bytes([192, 168, 1, 201]),
        bytes([255] * 4),
    )
    return bytes([255] * 6 + [1] * 6) + b"\x08\x00" + ip + udp + payload


def pcap(order="<", magic=0xA1B2C3D4, fraction=1e6):
    """A capture of TURNS turns, with a packet of the positioning port in between."""
    data = struct.pack(order + "IHHiIII", magic, 2, 4, 0, 0, 65535, 1)
    for number, block in enumerate(range(0, round(TURNS * 360 / BLOCK_DEG), 12)):
        seconds = 1_600_000_000 + block * BLOCK_S
        packets = [frame(vlp16_packet(block, 5e6))]
        if number == 20:
            packets.append(frame(bytes(512)))
        for packet in packets:
            whole = int(seconds)
            head = (whole, int((seconds - whole) * fraction), len(packet), len(packet))
            data += struct.pack(order + "IIII", *head) + packet
    return data


@pytest.mark.parametrize(
    "variant", [{}, {"order": ">"}, {"magic": 0xA1B23C4D, "fraction": 1e9}], ids=str
)
def test_a_capture_of_a_vlp16_gives_its_turns_with_rings_and_times(tmp_path, read, variant):
    path = tmp_path / "drive.pcap"
    path.write_bytes(pcap(**variant))
    outcome = read(path)
    assert outcome.exit_code == 0, outcome.messages
    full = [scan for scan in outcome.scans if len(scan.points) > 25000]
    assert len(full) >= TURNS - 1
    for scan in full:
        x, y, z = scan.points.astype(float).T
        elevation = np.degrees(np.arctan2(z, np.hypot(x, y)))
        np.testing.assert_allclose(np.linalg.norm(scan.points, axis=1), RANGE_M, atol=0.05)
        nearest = np.abs(elevation[:, None] - ELEVATIONS_DEG).argmin(axis=1)
        np.testing.assert_allclose(elevation, ELEVATIONS_DEG[nearest], atol=0.3)
        for ring in range(16):
            assert len(set(nearest[scan.ring == ring])) == 1
        assert np.ptp(scan.offset_ns) == pytest.approx(900 * BLOCK_S * 1e9, rel=0.05)
    steps = np.diff([scan.stamp_ns for scan in full])
    np.testing.assert_allclose(steps, 900 * BLOCK_S * 1e9, rtol=0.05)


def test_a_capture_that_is_cut_off_gives_what_is_whole(tmp_path, read):
    whole = pcap()
    path = tmp_path / "drive.pcap"
    for size in range(len(whole) - 1, len(whole) // 2, -len(whole) // 9):
        path.write_bytes(whole[:size])
        outcome = read(path, "--quiet")
        assert outcome.exit_code == 1
        points = sum(len(scan.points) for scan in outcome.scans)
        assert points >= 0.95 * len(whole[:size]) / 1264 * 384
        (sentence,) = outcome.messages
        assert f"cut off at byte {size}" in sentence


def test_other_captures_are_refused(tmp_path, read):
    path = tmp_path / "other.pcap"
    for data, words in (
        (pcap()[:24], "holds no sweep of a Velodyne"),
        (b"\x0a\x0d\x0d\x0a" + bytes(60), "editcap -F pcap"),
    ):
        path.write_bytes(data)
        outcome = read(path)
        assert (outcome.exit_code, outcome.scans) == (1, [])
        assert words in outcome.messages[-1]


def test_a_capture_has_no_topics_to_list(tmp_path, read):
    path = tmp_path / "drive.pcap"
    path.write_bytes(pcap())
    assert read(path, "--list").exit_code == 1
