#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Loads a data set with NumPy alone, as docs/dataset.md says, and holds it against the truth: dataset_numpy.py FARMBENCH"""
import filecmp
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

CLASSES = ["unlabelled", "ground", "crop", "weed", "other"]


def make(farmbench, folder, threads):
    subprocess.run([farmbench, "export", "smoke", "--dataset", "-o", folder, "-j", str(threads), "-q"], check=True)


def kitti_poses(sequence):
    """Poses of the lidar as SemanticKITTI's loaders make them: inv(Tr) pose Tr, from KITTI's two files."""
    calibration = {}
    for line in (sequence / "calib.txt").read_text().splitlines():
        key, numbers = line.split(":")
        calibration[key] = np.vstack([np.array(numbers.split(), float).reshape(3, 4), [0, 0, 0, 1]])
    assert list(calibration) == ["P0", "P1", "P2", "P3", "Tr"]
    lidar = calibration["Tr"]
    for line in (sequence / "poses.txt").read_text().splitlines():
        pose = np.vstack([np.array(line.split(), float).reshape(3, 4), [0, 0, 0, 1]])
        yield (np.linalg.inv(lidar) @ pose @ lidar)[:3]


def load(sequence):
    """World positions, classes, plots and plants of a sequence, all scans together."""
    poses = np.loadtxt(sequence / "poses.txt", ndmin=2).reshape(-1, 3, 4)
    times = np.loadtxt(sequence / "times.txt", ndmin=1)
    scans = sorted((sequence / "velodyne").iterdir())
    assert len(poses) == len(times) == len(scans)
    assert np.all(np.diff(times) > 0)
    assert np.allclose(poses, list(kitti_poses(sequence)), atol=0)
    worlds, labels, plants = [], [], []
    for scan, pose in zip(scans, poses):
        assert np.allclose(pose[:, :3] @ pose[:, :3].T, np.eye(3), atol=1e-9)
        points = np.fromfile(scan, np.float32).reshape(-1, 4)
        assert points[:, 3].min() >= 0 and points[:, 3].max() <= 1
        # A turn of the sensor, from where it hung: no point is farther than the ground aslant.
        assert np.linalg.norm(points[:, :3], axis=1).max() < 130
        worlds.append(points[:, :3] @ pose[:, :3].T + pose[:, 3])
        labels.append(np.fromfile(sequence / "labels" / (scan.stem + ".label"), np.uint32))
        plants.append(np.fromfile(sequence / "plants" / (scan.stem + ".plant"), np.uint32))
    labels = np.concatenate(labels)
    return np.concatenate(worlds), labels & 0xFFFF, labels >> 16, np.concatenate(plants)


def outside(world, plot):
    """How far points lie outside of a plot's box, metres; negative inside."""
    angle = np.radians(plot["heading_deg"])
    east, north = (world[:, :2] - plot["center_m"]).T
    along = np.abs(east * np.cos(angle) + north * np.sin(angle)) - plot["length_m"] / 2
    across = np.abs(north * np.cos(angle) - east * np.sin(angle)) - plot["width_m"] / 2
    return np.maximum(along, across)


def check_sequence(folder, told):
    world, classes, plots, plants = load(folder / "sequences" / told["sequence"])
    assert len(world) == len(classes) == len(plants) == told["points"]
    assert dict(zip(CLASSES, np.bincount(classes, minlength=5).tolist())) == told["points_by_class"]
    assert np.all((plants > 0) == (classes == 2)) and np.all((plots > 0) == (classes == 2))
    assert set(np.unique(plots)) - {0} == {plot["plot"] for plot in told["plots"]}
    for plot in told["plots"]:
        own = world[plots == plot["plot"]]
        off = outside(own, plot)
        assert np.median(off) < 0 and off.max() < 0.8  # leaves hang over by so much
        ground = world[(classes == 1) & (outside(world, plot) < 0.5)]
        top = own[:, 2].max() - np.median(ground[:, 2])
        # The highest of thousands of points, each with a noise of 3 cm, on ground that is not level.
        assert abs(top - plot["heights_m"]["height_max_m"]) < 0.35, (top, plot)


def main(farmbench):
    with tempfile.TemporaryDirectory() as work:
        folder, again = pathlib.Path(work, "one"), pathlib.Path(work, "two")
        make(farmbench, folder, 1)
        index = json.loads((folder / "dataset.json").read_text())
        assert index["classes"] == CLASSES and len(index["sequences"]) == 3
        for told in index["sequences"]:
            assert told["split"] == "train"  # one seed
            check_sequence(folder, told)
        card = (folder / "README.md").read_text()
        totals = [sum(told[key] for told in index["sequences"]) for key in ("scans", "points")]
        assert f"| train | 3 | {totals[0]} | {totals[1]} | 12 |" in card
        assert "farmbench export smoke --dataset -o DIR\n" in card and "Apache-2.0" in card
        make(farmbench, again, 2)
        files = [path.relative_to(folder) for path in sorted(folder.rglob("*")) if path.is_file()]
        assert files == [path.relative_to(again) for path in sorted(again.rglob("*")) if path.is_file()]
        assert filecmp.cmpfiles(folder, again, files, shallow=False)[0] == files


main(sys.argv[1])
