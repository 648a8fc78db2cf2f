# SPDX-License-Identifier: Apache-2.0
import _thread
import io
import threading
import unittest

import plotscan
import tqdm
from example_scan import SMALL, ExampleScan


class Simulate(ExampleScan):
    def test_farms_are_what_is_asked_for(self):
        self.assertEqual((self.made.plots, self.made.plants, self.made.seed), (9, 360, 101))
        truth = plotscan.read_truth(self.farm)
        tallest = max(plot.heights_m["height_max_m"] for plot in truth)
        self.assertAlmostEqual(tallest, self.made.plant_height_max_m, 6)

    def test_flights_are_what_is_asked_for(self):
        low = plotscan.fly(self.farm, self.folder / "low", spacing_m=12, speed_m_s=6)
        self.assertLess(low.duration_s, self.flown.duration_s)
        twin = plotscan.fly(self.farm, self.folder / "twin", spacing_m=12, speed_m_s=6, threads=1)
        self.assertEqual(low.points, twin.points)
        same = [(self.folder / name / "cloud.pcd").read_bytes() for name in ("low", "twin")]
        self.assertEqual(*same)

    def test_settings_are_told(self):
        settings = {setting.key: setting for setting in plotscan.flight_settings()}
        self.assertEqual(settings["altitude_m"].usual, 8)
        self.assertIn("crosshatch", settings["pattern"].choices)
        self.assertIn("metres", settings["spacing_m"].help)

    def test_errors_have_the_programs_text(self):
        with self.assertRaisesRegex(plotscan.BadInput, "--altitude"):
            plotscan.fly(self.farm, self.folder / "x", altitude_m=-1)
        with self.assertRaisesRegex(plotscan.BadInput, 'the flight has no "altitude"; it has'):
            plotscan.fly(self.farm, self.folder / "x", altitude=8)
        with self.assertRaisesRegex(plotscan.BadInput, "exists|is there"):
            plotscan.generate_farm("paper_flat", self.farm, set=SMALL)
        with self.assertRaisesRegex(plotscan.BadInput, "plants.cuont"):
            plotscan.generate_farm("paper_flat", self.folder / "x", set={"plants.cuont": 3})
        self.assertFalse((self.folder / "x").exists())

    def test_progress_is_told_in_the_calling_thread(self):
        told = []
        threads = set()

        def progress(share):
            told.append(share)
            threads.add(threading.get_ident())

        plotscan.fly(self.farm, self.folder / "told", progress=progress)
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[-1], 1)
        self.assertGreater(len(told), 3)
        self.assertEqual(threads, {threading.get_ident()})

    def test_tqdm_takes_progress(self):
        # As docs/python.md has it.
        drawn = io.StringIO()
        with tqdm.tqdm(total=1, file=drawn, mininterval=0) as bar:
            plotscan.fly(self.farm, self.folder / "bar", progress=lambda share: bar.update(share - bar.n))
        self.assertAlmostEqual(bar.n, 1, 12)
        self.assertIn("100%", drawn.getvalue())

    def test_what_progress_raises_ends_the_work(self):
        def progress(share):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            plotscan.fly(self.farm, self.folder / "stopped", progress=progress)
        self.assertEqual([p.name for p in self.folder.iterdir() if "stopped" in p.name], [])

    def test_interrupts_end_the_work(self):
        timer = threading.Timer(0.3, _thread.interrupt_main)
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            plotscan.fly(self.farm, self.folder / "interrupted", sub_rays=1024)
        timer.join()
        self.assertEqual([p.name for p in self.folder.iterdir() if "interrupted" in p.name], [])

    def test_other_threads_run_meanwhile(self):
        beats = []
        stop = threading.Event()
        beat = threading.Thread(target=lambda: [beats.append(1) for _ in iter(lambda: stop.wait(0.01), True)])
        beat.start()
        plotscan.fly(self.farm, self.folder / "meanwhile")
        stop.set()
        beat.join()
        self.assertGreater(len(beats), 3)


if __name__ == "__main__":
    unittest.main()
