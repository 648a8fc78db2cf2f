# SPDX-License-Identifier: Apache-2.0
"""A small farm and its scan, made once for the tests of a file."""

import shutil
import tempfile
import unittest
from pathlib import Path

import plotscan

SMALL = {
    "terrain.side_m": 30,
    "plots.rows.0.plots": 3,
    "plots.rows.1.plots": 3,
    "plots.rows.2.plots": 3,
    "plants.count": 40,
}


class ExampleScan(unittest.TestCase):
    """folder/farm and folder/scan: 3 x 3 plots of 40 plants on flat ground."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="plotscan-python-"))
        cls.farm = cls.folder / "farm"
        cls.scan = cls.folder / "scan"
        cls.made = plotscan.generate_farm("paper_flat", cls.farm, set=SMALL, seed=101)
        cls.flown = plotscan.fly(cls.farm, cls.scan, speed_m_s=5)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)
