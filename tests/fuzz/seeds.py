#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the seed corpus and the dictionaries of the fuzz targets: seeds.py FOLDER

FOLDER/<reader>/ gets small valid files of every form that the reader knows, FOLDER/<reader>.dict
the words of the format.
"""

import pathlib
import struct
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[2]
POINTS = [(5.0 * k - 20, 3.0 + k, 0.1 * k, 7.0, k % 16, 0.01 * k) for k in range(10)]
DICTIONARIES = {
    "scan_stream": ["LLSCSCAN", "SCAN", "sensor: vlp16", "\\x07\\x00\\x00\\x00"],
    "bin": ["\\x00\\x00\\xc0\\x7f"],  # NaN
    "pcd": "FIELDS SIZE TYPE COUNT WIDTH HEIGHT VIEWPOINT POINTS DATA ascii binary "
    "binary_compressed ring time timestamp intensity nan inf 1e300 "
    "18446744073709551615 1000000".split(),
    "ply": "ply format ascii binary_little_endian binary_big_endian element vertex face property "
    "list uchar int uint float double end_header comment ring time nan 1e300 "
    "18446744073709551615".split(),
    "trajectory": ["Tr:", "#", "nan", "inf", "1e308", "-0", "9e9", "1600000000.123456789"],
    "yaml": [
        "mapping:",
        "loop:",
        "scan_context:",
        "elevation_deg:",
        "beams:",
        "lowest_deg:",
        "highest_deg:",
        "sensor:",
        "point_times:",
        "&a",
        "*a",
        "!!map",
        "---",
        "...",
        "|",
        ">",
        "? ",
        "<<:",
        "%YAML",
        "[[",
        "{{",
        "1e308",
        ".nan",
    ],
}


def scan_stream():
    def scan(arrays, points):
        data = b"SCAN" + struct.pack("<IqI", arrays, 1_600_000_000_000_000_000, len(points))
        data += b"".join(struct.pack("<3f", *p[:3]) for p in points)
        data += b"".join(struct.pack("<f", p[3]) for p in points) if arrays & 1 else b""
        data += b"".join(struct.pack("<H", p[4]) for p in points) if arrays & 2 else b""
        data += b"".join(struct.pack("<i", int(p[5] * 1e9)) for p in points) if arrays & 4 else b""
        return data

    def header(text):
        return b"LLSCSCAN" + struct.pack("<II", 1, len(text)) + text

    yield header(b"")
    yield header(b"sensor: vlp16\nmotion_compensated: false\n") + scan(7, POINTS) + scan(0, [])
    yield header(b"") + scan(2, POINTS[:2]) + scan(5, POINTS[:3])


def kitti_bin():
    yield b""
    yield b"".join(struct.pack("<4f", *p[:4]) for p in POINTS)
    yield struct.pack("<8f", 0, 0, 0, 0, float("nan"), 1e30, -1e30, 1)


def pcd():
    head = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity ring time\nSIZE 4 4 4 4 2 8\n"
        f"TYPE F F F F U F\nCOUNT 1 1 1 1 1 1\nWIDTH {len(POINTS)}\nHEIGHT 1\n"
        f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(POINTS)}\nDATA "
    ).encode()
    layout = "<4fHd"
    yield head + b"ascii\n" + "".join(" ".join(map(str, p)) + "\n" for p in POINTS).encode()
    yield head + b"binary\n" + b"".join(struct.pack(layout, *p) for p in POINTS)
    by_field = b"".join(
        struct.pack("<" + letter, p[k]) for k, letter in enumerate("ffffHd") for p in POINTS
    )
    # As literals alone, 32 at a time.
    chunks = [by_field[at : at + 32] for at in range(0, len(by_field), 32)]
    packed = b"".join(bytes([len(chunk) - 1]) + chunk for chunk in chunks)
    yield (head + b"binary_compressed\n" + struct.pack("<II", len(packed), len(by_field)) + packed)
    # One zero, repeated.
    zeros = b"\x00\x00" + b"\xe0\xff\x00" * 2
    yield (
        b"FIELDS x y z\nSIZE 1 1 1\nTYPE I I I\nCOUNT 1 1 1\nWIDTH 7\nHEIGHT 25\n"
        b"DATA binary_compressed\n" + struct.pack("<II", len(zeros), 529) + zeros
    )
    yield (
        b"FIELDS x y z _ t\nSIZE 8 8 8 1 4\nTYPE F F F U U\nCOUNT 1 1 1 3 1\nWIDTH 2\nHEIGHT 1\n"
        b"DATA binary\n"
    ) + struct.pack("<3d3sI", 1, 2, 3, b"", 0) * 2


def ply():
    names = ["x", "y", "z", "intensity", "ring", "time"]
    types = ["float"] * 4 + ["ushort", "double"]

    def head(form, before=""):
        lines = [f"property {t} {n}" for t, n in zip(types, names, strict=True)]
        return (
            f"ply\nformat {form} 1.0\ncomment made\n{before}element vertex {len(POINTS)}\n"
            + "\n".join(lines)
            + "\nend_header\n"
        ).encode()

    faces = "element face 2\nproperty list uchar int index\n"
    yield head("ascii") + "".join(" ".join(map(str, p)) + "\n" for p in POINTS).encode()
    yield (
        head("ascii", faces)
        + b"3 0 1 2\n0\n"
        + "".join(" ".join(map(str, p)) + "\n" for p in POINTS).encode()
    )
    yield head("binary_little_endian") + b"".join(struct.pack("<4fHd", *p) for p in POINTS)
    yield (
        head("binary_big_endian", faces)
        + struct.pack(">BiiB", 2, 5, 6, 0)
        + b"".join(struct.pack(">4fHd", *p) for p in POINTS)
    )


def trajectory():
    yield (
        b"# stamp x y z qx qy qz qw\n1600000000.123456789 1 2 3 0 0 0 1\n"
        b"1600000001 -1 2e1 3 0.5 0.5 0.5 0.5\n"
    )
    yield b"1 0 0 1 0 1 0 2 0 0 1 3\n0 -1 0 1 1 0 0 2 0 0 1 3.5\r\n"
    yield b"0.0\n0.1\n1.600000000123e+09\n"
    yield b"P0: 1 2 3\nTr: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n"


def yaml():
    for folder in ("methods", "sensors"):
        for file in sorted((PROJECT / "config" / folder).glob("*.yaml")):
            yield file.read_bytes()
    yield (
        b"sensor: vlp16\nmotion_compensated: true\nelevation_correction_deg: 0.2\npoint_times: us\n"
    )
    yield b"loop: {scan_context: {threshold: 0.3}, min_travel: 25}\nmapping:\n  voxel_size: 0.4\n"
    yield b'"beams": 16\nlowest_deg: -15\nhighest_deg: 1.5e1\nclockwise: false # comment\n'
    yield b"elevation_deg:\n  - -15\n  - 0.5\n  - 15\n"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    makers = {
        "scan_stream": scan_stream,
        "bin": kitti_bin,
        "pcd": pcd,
        "ply": ply,
        "trajectory": trajectory,
        "yaml": yaml,
    }
    for reader, make in makers.items():
        (folder / reader).mkdir(parents=True, exist_ok=True)
        for number, data in enumerate(make()):
            (folder / reader / f"seed-{number}").write_bytes(data)
        words = "".join(f'"{word}"\n' for word in DICTIONARIES[reader])
        (folder / f"{reader}.dict").write_text(words)


if __name__ == "__main__":
    main()
