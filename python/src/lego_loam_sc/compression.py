# SPDX-License-Identifier: BSD-3-Clause
"""The compressions that bags use."""

import bz2
import sys
from collections.abc import Iterator
from typing import BinaryIO

from lz4.frame import LZ4FrameDecompressor

from lego_loam_sc.errors import InputError

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
LARGEST = 1 << 28  # bytes; more in one piece is damage or an attack
_MOST_PER_BYTE = 100  # of a packed file; recordings give less than ten
_PIECE = 1 << 20  # bytes

_DECOMPRESSORS = {
    "bz2": bz2.BZ2Decompressor,
    "lz4": LZ4FrameDecompressor,
    "zstd": zstd.ZstdDecompressor,
}


def decompress(kind: str, data: bytes | memoryview, size: int = LARGEST) -> bytes | memoryview:
    """At most `size` bytes of the content; fewer when `data` is cut off.

    Raises InputError when `data` is damaged or its compression is not known.
    """
    if kind in ("", "none"):
        return data
    if kind not in _DECOMPRESSORS:
        raise InputError(f'its compression "{kind}" is not known')
    if size > LARGEST:
        raise InputError(f"it promises {size} bytes, {LARGEST} are allowed")
    try:
        return _DECOMPRESSORS[kind]().decompress(data, max_length=size)
    except (OSError, EOFError, RuntimeError, ValueError, zstd.ZstdError) as error:
        raise InputError(f"it cannot be decompressed ({error})") from error


def unpack(packed: BinaryIO) -> Iterator[bytes]:
    """The content of a zstd file piece by piece. Raises InputError after the last good one."""
    decompressor = zstd.ZstdDecompressor()
    left = LARGEST  # bytes that may come
    try:
        while not decompressor.eof:
            piece = packed.read(_PIECE) if decompressor.needs_input else b""
            if decompressor.needs_input and not piece:
                raise InputError("it is cut off")
            unpacked = decompressor.decompress(piece, max_length=_PIECE)
            left += _MOST_PER_BYTE * len(piece) - len(unpacked)
            if left < 0:
                raise InputError(f"it gives more than {_MOST_PER_BYTE} times its size")
            yield unpacked
    except zstd.ZstdError as error:
        raise InputError(f"it is damaged ({error})") from error
