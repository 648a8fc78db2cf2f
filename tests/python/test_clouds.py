# SPDX-License-Identifier: Apache-2.0
import tempfile
import unittest
from pathlib import Path

import numpy
import plotscan


def some_points():
    points = numpy.zeros(1000, plotscan.point_dtype)
    points["x"] = 0.5 * numpy.arange(1000)
    points["y"] = -0.25
    points["intensity"] = numpy.arange(1000) % 256
    points["time"] = 0.001 * numpy.arange(1000)
    points["return_number"] = points["return_count"] = 1
    points["label"] = 2
    return points


class Clouds(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def test_what_is_written_is_read(self):
        points = some_points()
        for name in ("a.pcd", "a.ply"):
            plotscan.write_cloud(self.folder / name, points)
            cloud = plotscan.read_cloud(self.folder / name)
            self.assertEqual(len(cloud), 1000)
            for field in points.dtype.names:
                numpy.testing.assert_array_equal(cloud.points[field], points[field], field)

    def test_a_file_holds_what_numpy_says(self):
        plotscan.write_cloud(self.folder / "a.pcd", some_points(), encoding="ascii")
        lines = (self.folder / "a.pcd").read_text().splitlines()
        header = dict(line.split(" ", 1) for line in lines[:12] if not line.startswith("#"))
        rows = numpy.loadtxt(lines[len(lines) - 1000 :])
        fields = header["FIELDS"].split()
        numpy.testing.assert_array_equal(rows[:, fields.index("x")], 0.5 * numpy.arange(1000))
        numpy.testing.assert_array_equal(rows[:, fields.index("intensity")], numpy.arange(1000) % 256)

    def test_points_share_the_clouds_memory(self):
        plotscan.write_cloud(self.folder / "a.pcd", some_points())
        cloud = plotscan.read_cloud(self.folder / "a.pcd")
        cloud.points["z"][7] = 5
        self.assertEqual(cloud.points["z"][7], 5)
        points = cloud.points
        del cloud
        self.assertEqual(points["z"][7], 5)
        self.assertTrue(numpy.shares_memory(points["x"], points["z"].base))

    def test_origins_are_kept(self):
        far = (500_000.0, 4_100_000.0, 300.0)
        plotscan.write_cloud(self.folder / "a.las", some_points(), origin_m=far)
        cloud = plotscan.read_cloud(self.folder / "a.las")
        plotscan.write_cloud(self.folder / "b.pcd", cloud)
        back = plotscan.read_cloud(self.folder / "b.pcd")
        x = back.origin_m[0] + back.points["x"].astype(float)
        numpy.testing.assert_allclose(x, far[0] + 0.5 * numpy.arange(1000), atol=2e-4)

    def test_parts_of_arrays_are_written(self):
        points = some_points()
        plotscan.write_cloud(self.folder / "one.ply", points[::1000])
        self.assertEqual(len(plotscan.read_cloud(self.folder / "one.ply")), 1)
        plotscan.write_cloud(self.folder / "none.ply", numpy.zeros(0, plotscan.point_dtype))
        self.assertIn(b"element vertex 0", (self.folder / "none.ply").read_bytes())

    def test_clouds_are_converted(self):
        plotscan.write_cloud(self.folder / "a.pcd", some_points())
        self.assertEqual(plotscan.convert_cloud(self.folder / "a.pcd", self.folder / "a.las"), 1000)
        self.assertEqual((self.folder / "a.las").read_bytes()[:4], b"LASF")

    def test_errors_say_what_is_wrong(self):
        with self.assertRaisesRegex(plotscan.BadInput, "none.las"):
            plotscan.read_cloud(self.folder / "none.las")
        with self.assertRaisesRegex(plotscan.BadInput, "must end in one of"):
            plotscan.write_cloud(self.folder / "a.xls", some_points())
        with self.assertRaisesRegex(plotscan.BadInput, "point_dtype"):
            plotscan.write_cloud(self.folder / "a.pcd", numpy.zeros((5, 3)))
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
