# SPDX-License-Identifier: Apache-2.0
import json
import resource
import unittest

import numpy
import plotscan
from example_scan import ExampleScan


class Estimate(ExampleScan):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.cloud = plotscan.read_cloud(cls.scan)
        cls.field = plotscan.estimate_field(cls.cloud)

    def test_every_plot_is_found(self):
        scores = plotscan.score_estimate(self.field, self.farm)
        self.assertEqual((scores.plots, scores.found, scores.extra), (9, 9, 0))
        rmse = {(s.height, s.truth): s.rmse_m for s in scores.heights}
        self.assertLess(rmse["max", "height_max_m"], 0.06)

    def test_boxes_have_standard_errors(self):
        said = self.field.geojson["features"][0]["properties"]
        error = self.field.plots[0].box_error
        self.assertEqual((error.along_m, error.width_m), (said["se_center_along_m"], said["se_width_m"]))
        self.assertTrue(0 < error.width_m < 0.3)
        given = plotscan.estimate_field(self.cloud, boxes=[plot.box for plot in self.field.plots])
        self.assertIsNone(given.plots[0].box_error)

    def test_memory_gives_what_files_give(self):
        files = plotscan.estimate_files(self.scan, self.folder / "files")
        self.assertEqual(files.geojson, self.field.geojson)
        written = json.loads((self.folder / "files" / "plots.geojson").read_text())
        self.assertEqual(written, self.field.geojson)

    def test_arrays_of_any_layout_give_the_same(self):
        records = self.cloud.points
        columns = numpy.column_stack([records[axis] for axis in "xyz"])
        self.assertEqual(columns.dtype, numpy.float32)
        wide = numpy.zeros((len(records), 7))
        wide[:, :3] = columns
        for points in (records, columns, columns.astype(float), wide, wide[::1, :3]):
            self.assertEqual(plotscan.estimate_field(points, threads=1).geojson, self.field.geojson)

    def test_origin_moves_float32(self):
        moved = plotscan.estimate_field(self.cloud.points, origin_m=(1000, 2000, 0))
        before, after = self.field.plots[4].box, moved.plots[4].box
        self.assertAlmostEqual(after.center_x_m - before.center_x_m, 1000, 3)
        self.assertAlmostEqual(after.center_y_m - before.center_y_m, 2000, 3)

    def test_given_boxes_are_kept(self):
        truth = plotscan.read_truth(self.farm)
        given = plotscan.estimate_field(self.cloud, boxes=[plot.box for plot in truth])
        self.assertEqual(
            [(p.box.center_x_m, p.box.width_m) for p in given.plots],
            [(p.box.center_x_m, p.box.width_m) for p in truth],
        )

    def test_objects_say_what_they_hold(self):
        box = plotscan.Box(1, 2, 1.5, 4, 30)
        said = "Box(center_x_m=1.0, center_y_m=2.0, width_m=1.5, length_m=4.0, heading_deg=30.0)"
        self.assertEqual(repr(box), said)
        self.assertRegex(repr(self.field), r"^FieldEstimate\(method='lattice', plots=\[Plot\(.*, \.\.\.\], why_no_plots='', crs=''\)$")
        self.assertLess(len(repr(self.field)), 600)

    def test_table_has_a_row_a_plot(self):
        table = plotscan.plot_table(self.field.plots)
        self.assertEqual({len(column) for column in table.values()}, {9})
        self.assertEqual(table["max_m"][3], self.field.plots[3].heights["max"].value_m)
        self.assertTrue((table["max_low95_m"] < table["max_high95_m"]).all())
        self.assertEqual(sorted(set(table["row"])), [1, 2, 3])
        self.assertEqual(table["confidence"].tolist(), [plot.confidence for plot in self.field.plots])
        self.assertEqual(table["flags"].tolist(), ["; ".join(plot.flags) for plot in self.field.plots])
        self.assertEqual(plotscan.plot_table([])["flags"].tolist(), [])

    def test_ground_is_a_grid(self):
        ground = self.field.ground
        self.assertEqual(ground.z_m.ndim, 2)
        self.assertEqual(ground.z_m.shape, ground.sd_m.shape)
        view = ground.z_m[20:-20, 20:-20]  # beside the farm there is no ground
        self.assertLess(numpy.abs(view).max(), 0.1)  # the farm is flat
        del ground
        self.assertLess(numpy.abs(view).max(), 0.1)  # the view outlives what it came from

    def test_nothing_is_said(self):
        x, y = numpy.meshgrid(numpy.arange(0, 30, 0.1), numpy.arange(0, 30, 0.1))
        bare = plotscan.estimate_field(numpy.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()]))
        self.assertEqual(bare.plots, [])
        self.assertNotEqual(bare.why_no_plots, "")

    def test_bad_arrays_are_refused(self):
        columns = numpy.zeros((100, 3))
        for points in (columns[:, :2], columns.T[:2], numpy.asfortranarray(columns), columns.astype(int),
                       columns[0], columns[::-1], numpy.zeros(5, [("x", "f8"), ("y", "f8")])):  # fmt: skip
            with self.assertRaisesRegex(plotscan.BadInput, r"points are an array of shape \(N, 3\)"):
                plotscan.estimate_field(points)
        with self.assertRaisesRegex(plotscan.BadInput, "no point that is finite"):
            plotscan.estimate_field(numpy.full((5, 3), numpy.nan))
        for empty in (numpy.zeros((0, 3)), numpy.zeros((0, 3), numpy.float32), self.cloud.points[:0]):
            with self.assertRaisesRegex(plotscan.BadInput, "no point that is finite"):
                plotscan.estimate_field(empty)
        with self.assertRaisesRegex(plotscan.BadInput, "these are float64: add it to them"):
            plotscan.estimate_field(columns, origin_m=(500000, 4000000, 300))

    def test_lists_are_refused_in_one_line(self):
        rows = numpy.ones((1000, 3)).tolist()
        for call in (plotscan.estimate_field, lambda points: plotscan.write_cloud(self.folder / "list.pcd", points)):
            with self.assertRaisesRegex(plotscan.BadInput, "^points are a NumPy array or a cloud, not of type list; .*$"):
                call(rows)

    def test_masks_are_not_ignored(self):
        points = numpy.ma.array(self.cloud.points)
        self.assertEqual(plotscan.estimate_field(points).geojson, self.field.geojson)
        points[3] = numpy.ma.masked
        columns = numpy.ma.masked_greater(numpy.ones((100, 3)) * [1, 2, 300], 100)
        for masked in (points, columns):
            with self.assertRaisesRegex(plotscan.BadInput, "masks are not read"):
                plotscan.estimate_field(masked)
        with self.assertRaisesRegex(plotscan.BadInput, "masks are not read"):
            plotscan.write_cloud(self.folder / "masked.pcd", points)

    def test_float32_far_from_the_origin_is_refused(self):
        columns = numpy.column_stack([self.cloud.points[axis] for axis in "xyz"])
        moved = columns.astype(float) + (500000, 4600000, 300)
        moved[0] = numpy.nan
        moved[1] = 0  # one stray point near the origin
        with self.assertRaisesRegex(plotscan.BadInput, "the points lie up to [0-9]+ m .* in steps of 500 mm"):
            plotscan.estimate_field(moved.astype(numpy.float32))
        self.assertEqual(len(plotscan.estimate_field(moved).plots), 9)
        self.assertEqual(len(plotscan.estimate_field(columns, origin_m=(500000, 4600000, 300)).plots), 9)

    def test_nothing_that_is_told_is_ignored(self):
        boxes = [plot.box for plot in self.field.plots]
        with self.assertRaisesRegex(plotscan.BadInput, "rows is of the search for plots; boxes are given"):
            plotscan.estimate_field(self.cloud, boxes=boxes, rows=3)
        plotscan.estimate_field(self.cloud, boxes=boxes, crop="soybean")
        with self.assertRaisesRegex(plotscan.BadInput, "a cloud brings its own origin"):
            plotscan.estimate_field(self.cloud, origin_m=(1, 2, 3))
        truth = self.farm / "truth" / "plots.geojson"
        for told, message in (({"rows": 3}, "rows is of the search"), ({"numbering": "zigzag"}, "names of their own")):
            with self.assertRaisesRegex(plotscan.BadInput, message):
                plotscan.estimate_files(self.scan, self.folder / "x", boxes=truth, **told)
        with self.assertRaisesRegex(plotscan.BadInput, 'one of sw, se, nw, ne; not "north"'):
            plotscan.estimate_files(self.scan, self.folder / "x", first_corner="north")

    def test_bad_options_are_refused(self):
        with self.assertRaisesRegex(ValueError, 'crop "rice" must be one of maize'):
            plotscan.estimate_field(self.cloud, crop="rice")
        with self.assertRaisesRegex(plotscan.BadInput, 'lattice has no "widht"'):
            plotscan.estimate_files(self.scan, self.folder / "x", widht=3)
        with self.assertRaisesRegex(plotscan.BadInput, "none.pcd"):
            plotscan.estimate_files("none.pcd", self.folder / "x")
        self.assertFalse((self.folder / "x").exists())

    def test_points_are_not_copied(self):
        most = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024  # noqa: E731
        # Twenty million points, all in one square metre: the estimator keeps few of them.
        points = numpy.random.default_rng(1).random((20_000_000, 3), dtype=numpy.float32)
        before = most()
        try:
            plotscan.estimate_field(points, crop_box=(0, 0, 0.01, 0.01))
        except plotscan.BadInput:
            pass
        # The buffer of new points (tile_store.h) takes 340 MB; a copy would take another 240.
        self.assertLess(most() - before, 450e6)


if __name__ == "__main__":
    unittest.main()
