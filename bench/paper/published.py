# SPDX-License-Identifier: BSD-3-Clause
"""What the paper's tables 1 to 4 say, by method."""

LENGTH = 3724.187  # m, of KITTI 00

# Path length (m), its deviation (m), CPU share (%), time (s).
TABLE_1 = {
    "lego-loam": (3730.692, 6.505, 65, 570.167),
    "lego-loam-sc": (3727.583, 3.396, 61, 558.564),
}

# ATE and RPE: maximum, minimum, RMSE. The paper gives no unit for its RPE.
TABLE_2 = {
    "lego-loam": {"ATE": (11.177, 0.885, 4.976), "RPE": (6.173, 0.004, 0.159)},
    "lego-loam-sc": {"ATE": (5.652, 0.185, 2.206), "RPE": (2.289, 0.003, 0.079)},
}

# x, y, z, total (m), pitch, yaw ("drift angle"), roll, total (deg).
TABLE_3 = {
    "parking1": {
        "loam": (22.68, 3.57, 59.84, 64.09, -69.09, 8.01, 2.86, 70.42),
        "lego-loam": (-0.86, 0.14, 13.86, 13.89, -2.46, 0.74, 6.27, 6.78),
        "lego-loam-sc": (0.40, 0.10, 12.23, 12.24, 0.93, -6.26, -0.58, 6.39),
    },
    "parking2": {
        "loam": (20.36, -2.83, 38.32, 43.49, -75.87, 13.02, -26.83, 81.52),
        "lego-loam": (-1.24, 0.56, 8.92, 9.02, -6.36, -6.47, 4.43, 10.06),
        "lego-loam-sc": (-0.98, 0.09, 8.59, 8.65, -5.18, 2.51, 1.26, 5.89),
    },
}

# Path length (m), time (s).
TABLE_4 = {
    "parking1": {"lego-loam": (186.954, 220.364), "lego-loam-sc": (179.286, 211.864)},
    "parking2": {"lego-loam": (192.258, 234.950), "lego-loam-sc": (198.360, 225.268)},
}
