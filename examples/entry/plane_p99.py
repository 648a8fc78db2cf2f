#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A whole entry to a Plotscan benchmark in NumPy: in each given box, the 99th percentile of the points' heights over a plane
through the ground around it.

  farmbench export SUITE -o TASK --boxes
  plane_p99.py TASK SUBMISSION
  farmbench score SUBMISSION --suite SUITE

or as a command of a suite: plane_p99.py {cloud} {boxes_csv} {out_csv}
"""
import json
import pathlib
import shutil
import sys

import numpy as np

POINT = np.dtype([("xyz", "<f4", 3), ("intensity", "<f4"), ("ring", "<u2"), ("time", "<f8"), ("return", "u1", 2)])


def read_cloud(path):
    data = path.read_bytes()
    return np.frombuffer(data[data.index(b"DATA binary\n") + 12:], POINT)["xyz"].astype(float)


def height(xyz, box):
    x, y, width, length, heading = box
    east, north = (xyz[:, :2] - [x, y]).T
    angle = np.radians(heading)
    along = np.abs(east * np.cos(angle) + north * np.sin(angle)) - length / 2
    across = np.abs(north * np.cos(angle) - east * np.sin(angle)) - width / 2
    outside = np.maximum(along, across)  # metres, negative inside
    ring = xyz[(outside > 0.1) & (outside < 0.6)]
    ground = ring[ring[:, 2] < np.quantile(ring[:, 2], 0.3)]  # the rest are leaves
    plane = np.linalg.lstsq(np.c_[ground[:, :2], np.ones(len(ground))], ground[:, 2], rcond=None)[0]
    plot = xyz[outside < 0]
    return np.quantile(plot[:, 2] - np.c_[plot[:, :2], np.ones(len(plot))] @ plane, 0.99)


def measure(cloud, boxes, out):
    xyz = read_cloud(cloud)
    rows = [f"{box[0]:.0f},{height(xyz, box[1:]):.4f}" for box in np.genfromtxt(boxes, delimiter=",", skip_header=1, ndmin=2)]
    out.write_text("\n".join(["plot_number,height_p99_m", *rows]) + "\n")


def enter(task, submission):
    submission.mkdir()
    (submission / "submission.json").write_text(json.dumps({"method": "plane-p99"}))
    shutil.copy(task / "task.json", submission)
    for field in json.loads((task / "task.json").read_text())["fields"]:
        folder = task / field["field"]
        measure(folder / "cloud.pcd", folder / "boxes.csv", submission / f"{field['field']}.csv")


paths = [pathlib.Path(argument) for argument in sys.argv[1:]]
(measure if len(paths) == 3 else enter)(*paths)
