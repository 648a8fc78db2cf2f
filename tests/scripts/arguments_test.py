#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Scripts say how they are called, and refuse what they do not know, before they do anything.

usage: arguments_test.py SCRIPTS_FOLDER
"""
import importlib.machinery
import importlib.util
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

SCRIPTS = pathlib.Path(sys.argv[1])
sys.dont_write_bytecode = True


def called(script, *arguments):
    return subprocess.run([SCRIPTS / script, *arguments], capture_output=True, text=True, check=False, timeout=60)


def module_of(script):
    loader = importlib.machinery.SourceFileLoader(script, str(SCRIPTS / script))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(script, loader))
    loader.exec_module(module)
    return module


class Arguments(unittest.TestCase):
    def test_measurements_need_two_folders(self):
        for script in ("measure_beam", "measure_ground", "measure_growth", "measure_sway"):
            refused = called(script)
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("the following arguments are required: BIN_FOLDER, WORK_FOLDER", refused.stderr)
            self.assertEqual(called(script, "--help").returncode, 0)

    def test_an_unknown_option_or_suite_is_refused(self):
        for script, argument in (("format", "--chekc"), ("pictures", "--al"), ("package", "--tyr"), ("results", "papre"),
                                 ("leaderboard", "papre"), ("benchmark", "papre")):
            refused = called(script, argument)
            self.assertEqual(refused.returncode, 2, script)
            self.assertIn(argument, refused.stderr)

    def test_the_page_of_some_suites_says_which(self):
        results = module_of("results")
        row = {"plots": 1, "found": 1, "extra": 0, "iou_mean": 1, "rmse_m": None, "coverage95": None}
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder, "results.md")
            with mock.patch.object(results, "run_suite", return_value={"flat": {("lattice", "max"): row}}), \
                 mock.patch.object(results.subprocess, "run", return_value=mock.Mock(stdout="abc\n")), \
                 mock.patch.object(sys, "argv", ["results", "--seeds", "2", "--output", str(page), "paper", "steep"]):
                results.main()
            self.assertIn("Made by `scripts/results --seeds 2 paper steep` at abc.", page.read_text())

    def test_the_leaderboard_draws_seeds(self):
        board = module_of("leaderboard")
        one_seed = [[1.0, 2.0], [3.0], []]
        self.assertTrue(all(math.isnan(end) for end in board.bootstrap(one_seed, [1, 1, 2])))
        # Two farms of a seed are drawn together: nothing but one seed's two farms, the other's, or all three.
        low, high = board.bootstrap([[1.0], [1.0], [4.0]], [1, 1, 2])
        self.assertEqual((low, high), (1.0, 4.0))
        better, worse = [{1: 1.0}, {1: 1.0}], [{1: 2.0}, {1: 3.0}]
        self.assertTrue(board.is_better(better, worse, [1, 2]))
        self.assertFalse(board.is_better(worse, better, [1, 2]))
        self.assertFalse(board.is_better(better, worse, [1, 1]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
