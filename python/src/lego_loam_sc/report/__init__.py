# SPDX-License-Identifier: BSD-3-Clause
"""lego-loam-sc-report: one page that shows a run."""
