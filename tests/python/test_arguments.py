# SPDX-License-Identifier: Apache-2.0
"""Every argument reaches the compiled part, in its place and under its own name."""

import unittest
from pathlib import Path
from unittest import mock

import numpy
import plotscan
from plotscan import _plotscan


def sent(function, *arguments, **named):
    """What plotscan's function hands to the compiled one of its name."""
    with mock.patch.object(_plotscan, function) as compiled:
        getattr(plotscan, function)(*arguments, **named)
    compiled.assert_called_once()
    return compiled.call_args.args


class Arguments(unittest.TestCase):
    def expect_options(self, options, expected):
        self.assertEqual({name: getattr(options, name) for name in expected}, expected)

    def test_of_farms(self):
        options = {"set": {"terrain.relief_m": 0.5, "weeds": True}, "seed": 5, "threads": 3, "replace": True}
        made = sent("generate_farm", "description", "farm", progress=print, **options)
        self.assertEqual(made, ("description", "farm", ["terrain.relief_m=0.5", "weeds=true"], 5, 3, True, print))
        texts = {"a": (1, 2.5), "b": numpy.array([[1, 2], [3, 4]]), "c": "{d: 1}", "e": [True, "f"], "g": numpy.float32(0.5)}
        told = ["a=[1, 2.5]", "b=[[1, 2], [3, 4]]", "c={d: 1}", 'e=[true, "f"]', "g=0.5"]
        self.assertEqual(sent("generate_farm", "a", "b", set=texts)[2], told)
        self.assertEqual(sent("generate_farm", "a", "b"), ("a", "b", [], None, 0, False, None))
        self.assertEqual(sent("read_truth", "farm"), ("farm",))

    def test_of_flights(self):
        given = {"trajectory": Path("t"), "waypoints": Path("w"), "formats": ["las"], "resource_paths": [Path("r")],
                 "seed": 5, "threads": 3, "replace": True}  # fmt: skip
        settings = {"altitude_m": 9.0, "sensor": "os1_64", "lever_arm_m": [1.0, 2.0, 3.0]}
        place, folder, options, progress = sent("fly", "farm", "scan", progress=print, **given, **settings)
        self.assertEqual((place, folder, progress), ("farm", "scan", print))
        self.expect_options(options, {**given, "settings": settings})
        alone = sent("fly", "farm", "scan", formats="las", resource_paths="models")[2]
        self.expect_options(alone, {"formats": ["las"], "resource_paths": [Path("models")]})
        usual = {"trajectory": None, "waypoints": None, "formats": [], "resource_paths": [], "seed": 1, "threads": 0,
                 "replace": False, "settings": {}}  # fmt: skip
        self.expect_options(sent("fly", "farm", "scan")[2], usual)

    def test_of_clouds(self):
        self.assertEqual(sent("read_cloud", "file", progress=print), ("file", print))
        points = numpy.zeros(5, plotscan.point_dtype)
        given = {"origin_m": (1.0, 2.0, 3.0), "encoding": "ascii", "replace": True, "progress": print}
        written = sent("write_cloud", "file", points, **given)
        self.assertIs(written[1], points)
        self.assertEqual((written[0], *written[2:]), ("file", (1.0, 2.0, 3.0), "", "ascii", True, print))
        given = {"encoding": "ascii", "crs": "utm", "topic": "/points", "replace": True, "progress": print}
        converted = sent("convert_cloud", "source", "file", **given)
        self.assertEqual(converted, ("source", "file", "ascii", "utm", "/points", True, print))

    def test_of_estimates(self):
        field = {"crop_box": [1.0, 2.0, 3.0, 4.0], "threads": 3}
        settings = {"heading_deg": 5.0, "rows": 8.0, "crop": "maize", "calibrated": False, "ground_classes": [2.0]}
        given = {**field, **settings, "columns": None, "progress": print}
        points = numpy.zeros((5, 3))
        boxes = [plotscan.Box(1, 2, 3, 4, 5)]
        sent_points, options, origin_m, progress = sent(
            "estimate_field", points, boxes=boxes, origin_m=(1.0, 2.0, 3.0), **given
        )
        self.assertIs(sent_points, points)
        self.assertEqual((origin_m, progress), ((1.0, 2.0, 3.0), print))
        self.expect_options(options, {**field, "settings": settings})
        self.assertIs(options.settings["calibrated"], False)
        self.assertEqual([box.width_m for box in options.boxes], [3])

        files = {"method": "dhami2020", "boxes": Path("map"), "id": "name", "units": "ft",
                 "leave_out_classes": [5, 6], "measured": Path("ruler"), "csv": Path("table"), "seed": 5, "replace": True}  # fmt: skip
        files |= {"crs": "EPSG:32617", "trajectory": Path("flown"), "sensor": "vlp16", "mount_rpy_deg": [0.0, 90.0, 0.0],
                  "topic": "/points", "first_number": 101, "numbering": "serpentine", "first_corner": "nw",
                  "plot_names": Path("names")}  # fmt: skip
        clouds, folder, options, progress = sent("estimate_files", "scan", "out", **files, **given)
        self.assertEqual((clouds, folder, progress), (["scan"], "out", print))
        self.expect_options(options, files)
        self.expect_options(options.field, {**field, "settings": settings})
        self.assertEqual(sent("estimate_files", ["a", Path("b")], "out")[0], ["a", Path("b")])
        self.assertEqual(sent("estimate_settings"), ("lattice",))

    def test_of_seeds(self):
        self.assertEqual(sent("generate_farm", "a", "b", seed=2**64 - 1)[3], 2**64 - 1)
        self.assertEqual(sent("fly", "farm", "scan", seed=numpy.int32(7))[2].seed, 7)
        self.assertEqual(sent("estimate_files", "scan", "out", seed=0)[2].seed, 0)
        for function in (plotscan.generate_farm, plotscan.fly, plotscan.estimate_files):
            for seed in (-1, 2**64, 1.5, "1"):
                with self.assertRaisesRegex(plotscan.BadInput, f"^seed: {seed!r} is not a whole number in .0, 18446744073709551615.$"):
                    function("absent", "out", seed=seed)

    def test_of_scores(self):
        self.assertEqual(sent("score_estimate", "estimate", "farm", min_iou=0.7), ("estimate", "farm", 0.7, ""))
        self.assertEqual(sent("score_estimate", "estimate", "farm"), ("estimate", "farm", 0.5, ""))
        self.assertEqual(sent("score_estimate", "estimate", "t.csv", id="barcode"), ("estimate", "t.csv", 0.5, "barcode"))


if __name__ == "__main__":
    unittest.main()
