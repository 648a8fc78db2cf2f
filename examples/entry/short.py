# SPDX-License-Identifier: Apache-2.0
# An entry in a dozen lines, NumPy alone (docs/submissions.md): python3 short.py TASK SUBMISSION
import json, pathlib, sys
import numpy as np

task, submission = map(pathlib.Path, sys.argv[1:])
submission.mkdir()
(submission / "submission.json").write_text('{"method": "plane-p99-short"}')
(submission / "task.json").write_bytes((task / "task.json").read_bytes())
point = np.dtype({"names": ["x", "y", "z"], "formats": ["<f4"] * 3, "itemsize": 28})
for field in [entry["field"] for entry in json.loads((task / "task.json").read_text())["fields"]]:
    cloud = np.fromfile(task / field / "cloud.pcd", point, offset=512)
    rows = ["plot_number,height_p99_m"]
    for plot, x, y, width, length, heading in np.loadtxt(task / field / "boxes.csv", delimiter=",", skiprows=1, ndmin=2):
        turn = (cloud["x"] - x + 1j * (cloud["y"] - y)) * np.exp(-1j * np.radians(heading))  # along + 1j * across
        crop = (abs(turn.real) < length / 2) & (abs(turn.imag) < width / 2)
        ends = (abs(abs(turn.real) - length / 2 - 0.5) < 0.2) & (abs(turn.imag) < width / 2)  # the ground before and behind it
        plane = np.linalg.lstsq(np.c_[turn.real, turn.imag, np.ones(len(turn))][ends], cloud["z"][ends], rcond=None)[0]
        above = cloud["z"][crop] - np.c_[turn.real, turn.imag, np.ones(len(turn))][crop] @ plane
        rows.append(f"{plot:.0f},{np.percentile(above, 99):.3f}")
    (submission / f"{field}.csv").write_text("\n".join(rows) + "\n")
