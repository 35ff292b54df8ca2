# SPDX-License-Identifier: BSD-3-Clause
"""lego-loam-sc-report: what run or inspect left in, report.html out."""

import argparse
import os
import sys
from importlib.metadata import version
from pathlib import Path

from lego_loam_sc.errors import InputError


def main(arguments: list[str] | None = None) -> int:
    """The program. Returns 0, or 1 when the run cannot be read or the page not be written."""
    options = _parse(arguments)
    output = options.output or options.folder / "report.html"
    try:
        page = _make(options)
        _write(output, page)
    except InputError as error:
        print(f"lego-loam-sc-report: {error}", file=sys.stderr)
        return 1
    if not options.quiet:
        print(f"report in {output}, {len(page.encode()) / 1e6:.1f} MB")
    return 0


def _make(options: argparse.Namespace) -> str:
    # Importing takes a while; --help need not wait for it.
    from lego_loam_sc.report import page, results, stages

    try:
        if (options.folder / stages.FACTS).is_file():
            return stages.make_stage_page(options.folder)
        return page.make_page(results.read_results(options.folder), options.points)
    except (KeyError, IndexError, ValueError) as error:
        raise InputError(
            f"the files in {options.folder} do not fit together or are of another version "
            f"({type(error).__name__}: {error}); run again"
        ) from error


def _parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="lego-loam-sc report",
        description="Writes one page, DIR/report.html, that shows what run or inspect left and "
        "needs no network.",
    )
    parser.add_argument("folder", metavar="DIR", type=Path, help="what run or inspect left")
    parser.add_argument("-o", "--output", type=Path, help="another file for the page")
    parser.add_argument(
        "--points",
        type=int,
        default=1_000_000,
        help="at most this many points of the map [default: 1000000, for which the page has 20 MB]",
    )
    parser.add_argument("--quiet", action="store_true", help="print errors only")
    parser.add_argument("--version", action="version", version=version("lego-loam-sc"))
    return parser.parse_args(arguments)


def _write(path: Path, text: str) -> None:
    """Replaces an old report as a whole."""
    beside = path.with_name(path.name + ".part")
    try:
        beside.write_text(text, encoding="utf-8")
        os.replace(beside, path)
    except OSError as error:
        beside.unlink(missing_ok=True)
        raise InputError(f"{path} cannot be written: {error.strerror}") from error


if __name__ == "__main__":
    sys.exit(main())
