# SPDX-License-Identifier: BSD-3-Clause
"""Velodyne captures (.pcap)."""

import mmap
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from lego_loam_sc.errors import InputError, Report
from lego_loam_sc.point_cloud import RawScan, pick_fields

_NS_OF_FRACTION = {0xA1B2C3D4: 1_000, 0xA1B23C4D: 1}
_PCAPNG = b"\x0a\x0d\x0d\x0a"
_PACKET = 1206  # bytes of payload
_FIRST_BLOCK = b"\xff\xee"  # of a data packet of every model


def is_capture(magic: bytes) -> bool:
    """True for a file that begins like one of tcpdump or Wireshark."""
    return magic[:4] == _PCAPNG or _byte_order(magic) is not None


def read_scans(path: Path, report: Report) -> Iterator[RawScan]:
    """The sweeps of a capture, stamped with the clock of the computer that captured.

    Raises InputError when there are none or the sensor's calibration is not in the capture.
    """
    import velodyne_decoder  # takes long to load, and bags do not need it

    with path.open("rb") as file:
        if file.read(4) == _PCAPNG:
            raise InputError(f"{path} is a pcapng file; convert it: editcap -F pcap {path} NEW")
    try:
        model, calibration = velodyne_decoder.hdl64e.detect_hdl64e(str(path))
    except ValueError as error:
        raise InputError(
            f"{path}: the calibration of the HDL-64E is not in it ({error})"
        ) from error
    decoder = velodyne_decoder.StreamDecoder(
        velodyne_decoder.Config(model=model, calibration=calibration)
    )
    scans = 0
    for stamp_ns, packet in _packets(path, report):
        decoded = decoder.decode(stamp_ns * 1e-9, packet, True)
        if decoded is not None:
            scans += 1
            yield _to_scan(*decoded)
    decoded = decoder.finish(True)
    if decoded is not None:
        scans += 1
        yield _to_scan(*decoded)
    if not scans:
        raise InputError(
            f"{path} holds no sweep of a Velodyne sensor; of another sensor record a bag with its "
            "driver"
        )


def _to_scan(stamp: Any, points: np.ndarray) -> RawScan:
    """`stamp` is a TimePair of the decoder."""
    return pick_fields(points.reshape(1, -1), round(stamp.host * 1e9))


def _byte_order(magic: bytes) -> str | None:
    for order in "<>":
        if len(magic) >= 4 and struct.unpack(order + "I", magic[:4])[0] in _NS_OF_FRACTION:
            return order
    return None


def _packets(path: Path, report: Report) -> Iterator[tuple[int, bytes]]:
    """Stamp and payload of each data packet."""
    with path.open("rb") as file:
        data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    order = _byte_order(data[:4])
    fraction_ns = _NS_OF_FRACTION[struct.unpack(order + "I", data[:4])[0]]
    at = 24
    while at < len(data):
        frame_at = at + 16
        if frame_at <= len(data):
            seconds, fraction, length, _ = struct.unpack_from(order + "IIII", data, at)
            at = frame_at + length
        if frame_at > len(data) or at > len(data):
            report(f"{path}: it is cut off at byte {len(data)}; all complete packets are read")
            return
        # The payload ends the frame, whatever headers stand before it.
        payload = data[at - _PACKET : at] if length > _PACKET else b""
        if payload.startswith(_FIRST_BLOCK):
            yield seconds * 1_000_000_000 + fraction * fraction_ns, payload
