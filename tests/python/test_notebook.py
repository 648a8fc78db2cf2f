# SPDX-License-Identifier: Apache-2.0
"""The notebook of examples/, run as a reader would."""

import os
import re
import tempfile
import unittest
from pathlib import Path

NOTEBOOK = Path(__file__).parents[2] / "examples" / "farm_to_figure.ipynb"


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        home = tempfile.TemporaryDirectory()  # Jupyter, IPython and matplotlib keep their files there
        cls.addClassCleanup(home.cleanup)
        os.environ["HOME"] = home.name
        import nbclient
        import nbformat

        cls.notebook = nbformat.read(NOTEBOOK, as_version=4)
        cls.cells = [cell for cell in cls.notebook.cells if cell.cell_type == "code"]
        cls.stored = [cell.outputs for cell in cls.cells]
        nbclient.NotebookClient(cls.notebook, kernel_name="python3", timeout=250).execute(cwd=home.name)
        cls.outputs = [output for cell in cls.cells for output in cell.outputs]
        cls.text = "".join(output.text for output in cls.outputs if output.output_type == "stream")

    def test_finds_the_plots_that_it_made(self):
        self.assertIn("24 plots, 1920 plants", self.text)
        self.assertIn("24 of 24 plots found, 0 that are none", self.text)
        rmse_cm = [float(error) for error in re.findall(r"RMSE ([\d.]+) cm", self.text)]
        self.assertEqual(len(rmse_cm), 2)
        self.assertLess(max(rmse_cm), 4)

    def test_draws_its_figures_and_says_nothing_else(self):
        figures = [output for output in self.outputs if output.output_type == "display_data"]
        self.assertEqual(len(figures), 2)
        for figure in figures:
            self.assertGreater(len(figure.data["image/png"]), 10000)
        warnings = [output.text for output in self.outputs if output.get("name") == "stderr"]
        self.assertEqual(warnings, [])

    def test_is_kept_without_outputs(self):
        self.assertEqual([outputs for outputs in self.stored if outputs], [])

    def test_links_lead_somewhere(self):
        told = "".join(cell.source for cell in self.notebook.cells if cell.cell_type == "markdown")
        links = re.findall(r"\]\(([^)]+)\)", told)
        self.assertGreater(len(links), 3)
        for link in links:
            self.assertTrue((NOTEBOOK.parent / link).is_file(), link)


if __name__ == "__main__":
    unittest.main()
