# SPDX-License-Identifier: BSD-3-Clause
"""Companion of LeGO-LOAM-SC: reads recordings and writes them as a scan stream."""
