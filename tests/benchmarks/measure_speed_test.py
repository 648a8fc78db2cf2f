#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/measure_speed makes of what it measured: stages, rows, medians, alarms. Nothing here is timed.

usage: measure_speed_test.py SCRIPT FARMGEN
"""
import importlib.machinery
import importlib.util
import math
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

SCRIPT, FARMGEN = sys.argv[1:3]
sys.dont_write_bytecode = True
LOADER = importlib.machinery.SourceFileLoader("measure_speed", SCRIPT)
speed = importlib.util.module_from_spec(importlib.util.spec_from_loader("measure_speed", LOADER))
LOADER.exec_module(speed)


def row(ratio):
    return {"ours_s": 1.0, "reference_s": ratio, "ratio": ratio, "label": "reference"}


class FakeInputs:
    """In place of programs: each round's rows."""
    rows = {}

    def __init__(self, programs, work):
        pass

    def measured(self):
        return self.rows


class MeasureSpeed(unittest.TestCase):
    def test_stages_are_read_from_what_a_program_says(self):
        with tempfile.TemporaryDirectory() as work:
            done = subprocess.run([FARMGEN, "generate", "paper_flat", "-o", work + "/farm", "-v", "-j", "1", "--set",
                                   "plots.rows=[{plots: 1}]"], capture_output=True, text=True, check=True)
        self.assertEqual(list(speed.stages_of(done.stderr)),
                         ["description", "terrain", "plant models", "plants", "canopies", "writing"])

    def test_a_stage_has_the_seconds_of_processors(self):
        self.assertEqual(speed.stages_of("estimator: plots' heights   9.000 s    0.125 s of processors\n"
                                         "estimator: plots   8.000 s    0.250 s of processors  30 plots\n"),
                         {"plots' heights": 0.125, "plots": 0.25})

    def test_stages_become_rows_with_shares_and_ratios(self):
        rows = speed.stage_rows("run", {"long": 0.3, "short": 0.001}, 0.6, "reference")
        self.assertAlmostEqual(rows["run: long"]["ratio"], 2)
        self.assertAlmostEqual(rows["run: long"]["share"], 0.3 / 0.301)
        self.assertTrue(math.isnan(rows["run: short"]["ratio"]))
        self.assertAlmostEqual(rows["run: all stages"]["ours_s"], 0.301)

    def test_medians_are_of_every_number(self):
        self.assertEqual(speed.medians([{"a": row(1)}, {"a": row(9)}, {"a": row(2)}])["a"], row(2))

    def test_cells_hold_rates(self):
        self.assertEqual(speed.cells("reading .pcd", {"ours_s": 0.5, "reference_s": 0.1, "ratio": 0.2, "label": "bytes",
                                                      "points": 1e6, "bytes": 4e7}),
                         ["reading .pcd", "2 Mpoints/s, 80 MB/s", "bytes: 400 MB/s", "0.2"])

    def test_an_alarm_names_the_row_that_is_slower_than_usual(self):
        lines = speed.alarms([{"fast": row(0.34), "slow": row(0.32), "unknown": row(0.01)}], {"fast": 1, "slow": 1})
        self.assertEqual(lines, ["slow: ratio 0.32, usually 1; below 0.333"])

    def test_an_alarm_needs_every_round_to_be_slow(self):
        rounds = [{"once": row(0.1), "always": row(0.1)}, {"once": row(0.9), "always": row(0.2)}]
        self.assertEqual(speed.alarms(rounds, {"once": 1, "always": 1}), ["always: ratio 0.2, usually 1; below 0.333"])

    def test_what_has_a_reference_of_another_kind_has_more_room(self):
        usual = {"writing .pcd": 1, "reading .las": 1, "farmgen generate: plant models": 1}
        rows = {"writing .pcd": row(0.17), "reading .las": row(0.16), "farmgen generate: plant models": row(0.17)}
        self.assertEqual(speed.alarms([rows], usual), ["reading .las: ratio 0.16, usually 1; below 0.167"])

    def test_an_alarm_names_a_row_that_is_gone_unless_the_build_lacks_the_format(self):
        self.assertEqual(speed.alarms([{}], {"a stage": 1, "reading .laz": 1}), ["a stage: not measured"])

    def test_the_command_fails_by_the_alarm_alone(self):
        for ratio, arguments, fails in [(0.3, ["--alarm"], True), (0.4, ["--alarm"], False), (0.3, [], False)]:
            FakeInputs.rows = {"slow": row(ratio)}
            with (self.subTest(ratio=ratio, arguments=arguments), mock.patch.object(speed, "Inputs", FakeInputs),
                  mock.patch.object(speed, "USUAL", {"slow": 1}), mock.patch.object(speed, "print_table"),
                  mock.patch.object(sys, "argv", ["measure_speed", "--bin", ".", *arguments])):
                if fails:
                    self.assertRaisesRegex(SystemExit, "slow: ratio 0.3", speed.main)
                else:
                    speed.main()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
