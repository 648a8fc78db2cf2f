# SPDX-License-Identifier: Apache-2.0
"""What the module offers, what its stubs say, and what its docstrings tell: the same names."""

import ast
import inspect
import re
import unittest
from pathlib import Path

import plotscan
from plotscan import _plotscan


def stubbed(node):
    """The names that a class or module of the stubs declares."""
    names = {}
    for child in node.body:
        if isinstance(child, (ast.FunctionDef, ast.ClassDef)):
            names[child.name] = child
        elif isinstance(child, ast.AnnAssign):
            names[child.target.id] = child
    return names


def public(names):
    return {name for name in names if not name.startswith("_")}


class Interface(unittest.TestCase):
    def setUp(self):
        text = Path(plotscan.__file__).with_name("_plotscan.pyi").read_text()
        self.stubs = stubbed(ast.parse(text))

    def test_stubs_name_what_is_there(self):
        self.assertEqual(public(self.stubs), public(vars(_plotscan)))
        for name, node in self.stubs.items():
            if isinstance(node, ast.ClassDef) and not issubclass(getattr(_plotscan, name), Exception):
                self.assertEqual(public(stubbed(node)), public(vars(getattr(_plotscan, name))), name)

    def test_stubs_count_the_arguments(self):
        for name, node in self.stubs.items():
            if not isinstance(node, ast.FunctionDef):
                continue
            # pybind11 writes a signature in the first line: name(arg0: ..., arg1: ...) -> ...
            # Overloaded ones have a line each, behind one of *args.
            told = [line for line in getattr(_plotscan, name).__doc__.splitlines() if " -> " in line]
            counts = {len(re.findall(r"\barg\d", line)) for line in told if "*args" not in line}
            self.assertEqual(counts, {len(node.args.posonlyargs)}, name)

    def test_all_is_what_is_public(self):
        modules = {"annotations", "json", "os", "reprlib", "numpy", "Any", "Callable", "Dict", "List", "Mapping", "Optional",
                   "Sequence", "Tuple", "Union", "Path", "Progress", "SettingValue"}  # fmt: skip
        self.assertEqual(public(vars(plotscan)) - modules, set(plotscan.__all__))

    def test_functions_tell_of_their_arguments_and_errors(self):
        for name in plotscan.__all__:
            function = getattr(plotscan, name)
            if not inspect.isfunction(function):
                continue
            told = inspect.getdoc(function)
            for argument in set(inspect.signature(function).parameters) - {"progress", "threads", "replace", "seed"}:
                self.assertIn(argument, told, f"{name} says nothing of {argument}")
            if name not in ("flight_settings", "plot_table", "score_estimate"):
                self.assertIn("Raises BadInput", told, name)

    def test_errors_are_value_errors(self):
        self.assertTrue(issubclass(plotscan.BadInput, ValueError))
        self.assertTrue(issubclass(plotscan.NothingMeasured, plotscan.BadInput))


if __name__ == "__main__":
    unittest.main()
