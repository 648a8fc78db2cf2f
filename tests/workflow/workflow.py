#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""workflow/Snakefile makes of a planned suite what farmbench run makes on one machine, and goes on where it was killed.

usage: workflow.py local|slurm FARMBENCH SOURCE_FOLDER

Ends with 77 where Snakemake 7, or what a Slurm needs, is not there.
"""
import collections
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import slurm

SUITE = """
name: tiny
cases:
  - name: flat
    farm: {source}/worlds/paper_flat.yaml
    set: &small {{terrain.side_m: 30, terrain.vertices: 20, "plots.rows": "[{{plots: 4}}]", plants.count: 30}}
  - {{name: half, farm: {source}/worlds/paper_half.yaml, set: *small{flight}}}
seeds: [5001, 5002, 5003]
flight: {{altitude_m: 6, speed_m_s: 3}}
methods: [lattice, one-number]
"""
SWEEP = """
name: swept
farm: {source}/worlds/paper_flat.yaml
set: {{terrain.side_m: 30, terrain.vertices: 20, "plots.rows": "[{{plots: 4}}]", plants.count: 30}}
axes: {{altitude_m: [6, 8]}}
seeds: [5001]
methods: [one-number]
"""
FARMS = [f"{case}-{seed}" for case in ("flat", "half") for seed in (5001, 5002, 5003)]
VIEWED = ["flat-5001", "half-5001"]
REPORTS = ["table.csv", "results.json", "leaderboard.md", "report.html"]


def check(what, holds):
    if not holds:
        sys.exit(f"workflow: not so: {what}")


class Trial:
    """A folder of tests: suites, results, and a farmbench that writes down what it is asked for."""

    def __init__(self, kind, farmbench, source, folder, environment):
        self.kind, self.farmbench, self.source, self.folder = kind, farmbench, source, folder
        self.environment = environment
        self.calls = folder / "calls"
        self.counting = folder / "farmbench"
        self.counting.write_text(f'#!/bin/sh\necho "$1 $3" >>{self.calls}\nexec {farmbench} "$@"\n')
        self.counting.chmod(0o755)

    def run(self, *arguments, exit_code=0):
        ended = subprocess.run([self.farmbench, *map(str, arguments)], capture_output=True, text=True, check=False)
        check(f"{arguments} ends with {exit_code}: {ended.stdout}{ended.stderr}", ended.returncode == exit_code)
        return ended.stdout + ended.stderr

    def suite(self, name, flight=""):
        file = self.folder / f"{name}.yaml"
        file.write_text(SUITE.format(source=self.source, flight=flight))
        return file

    def plan(self, suite, name):
        results = self.folder / name
        self.run("plan", suite, "-o", results)
        self.calls.write_text("")
        return results

    def snakemake(self, results, *arguments):
        """Started, in a session of its own."""
        jobs = ["--cores", "2"] if self.kind == "local" else []
        command = ["snakemake", "--snakefile", str(self.source / "workflow/Snakefile"), "--profile",
                   str(self.source / "workflow" / self.kind), "--directory", str(results), *jobs, *arguments,
                   "--config", f"farmbench={self.counting}"]
        log = open(self.folder / "snakemake.log", "w", encoding="utf-8")
        return subprocess.Popen(command, stdout=log, stderr=log, env=self.environment, start_new_session=True)

    def finish(self, results, *arguments):
        """Snakemake's exit code and what it said."""
        code = self.snakemake(results, *arguments).wait()
        return code, (self.folder / "snakemake.log").read_text(encoding="utf-8")

    def runs(self):
        """How often each farm was run since the plan."""
        calls = [line.split() for line in self.calls.read_text().splitlines()]
        return collections.Counter(call[1] for call in calls if call[0] == "farm")


def same(one, other, files):
    for file in files:
        check(f"{file} has the same bytes in {one.name} and {other.name}",
              (one / file).read_bytes() == (other / file).read_bytes())


def same_results(trial, whole, results):
    """All but the times, and with the same times the reports too, which show them."""
    same(whole, results, ["table.csv", "results.json", *(f"farms/{farm}.json" for farm in FARMS),
                          *(f"views/{farm}.cbor" for farm in VIEWED)])
    shutil.rmtree(whole / "times")
    shutil.copytree(results / "times", whole / "times")
    trial.run("report", whole)
    same(whole, results, REPORTS)


def runs_as_on_one_machine(trial, whole, suite):
    results = trial.plan(suite, "planned")
    code, said = trial.finish(results)
    check(f"the workflow ends well: {said}", code == 0)
    same_results(trial, whole, results)
    check(f"every farm ran once: {trial.runs()}", trial.runs() == {farm: 1 for farm in FARMS})
    trial.run("plan", suite, "-o", results)
    code, said = trial.finish(results)
    check(f"nothing is left to do: {said}", code == 0 and "Nothing to be done" in said and trial.runs().total() == 6)


def shows_other_truths(trial, suite):
    """The suite's reports are made again, of farms that have run."""
    before = suite.read_text()
    results = trial.folder / "planned"
    suite.write_text(before + "truths: [height_max_m]\n")
    trial.plan(suite, "planned")
    code, said = trial.finish(results)
    check(f"the workflow merges again: {said}", code == 0 and trial.calls.read_text() == "merge \n")
    check("it shows the other truth alone", "truth height_mean_m" not in (results / "leaderboard.md").read_text())
    suite.write_text(before)


def goes_on_after_kill(trial, whole, suite):
    results = trial.plan(suite, "killed")
    running = trial.snakemake(results)
    while len(list((results / "farms").glob("*.json"))) < 2:
        check("the workflow runs until it is killed", running.poll() is None)
        time.sleep(0.1)
    os.killpg(running.pid, signal.SIGKILL)
    running.wait()
    finished = [file.stem for file in (results / "farms").glob("*.json")]
    check("it was killed half-way", 2 <= len(finished) < 6)
    code, said = trial.finish(results, "--unlock")
    check(f"the folder is unlocked: {said}", code == 0)
    code, said = trial.finish(results)
    check(f"the workflow goes on: {said}", code == 0)
    runs = trial.runs()
    check(f"what was finished ran once: {runs}", all(runs[farm] == 1 for farm in finished))
    # Slurm's jobs run on while Snakemake is gone; a local run's farms die with it, two at most.
    again = sum(runs.values()) - len(FARMS)
    check(f"nothing else is lost or done twice: {runs}", set(runs) == set(FARMS)
          and again <= (2 if trial.kind == "local" else 0))
    same(whole, results, ["table.csv", "results.json"])
    check("no work is left", not list(results.glob(".*.work-*")))


def a_sweep_shows_no_farm(trial):
    """Whose view the workflow would wait for."""
    suite = trial.folder / "sweep.yaml"
    suite.write_text(SWEEP.format(source=trial.source))
    results = trial.plan(suite, "sweep")
    code, said = trial.finish(results)
    check(f"a sweep ends well: {said}", code == 0 and (results / "sweep.csv").exists())
    check(f"its farms ran once: {trial.runs()}", trial.runs() == {"6-5001": 1, "8-5001": 1})


def a_failing_farm_stops_no_other(trial, whole):
    """The half farms are flown into the crop."""
    results = trial.plan(trial.suite("failing", ", flight: {altitude_m: 0.5}"), "failing")
    code, said = trial.finish(results)
    check(f"the failure is reported: {said}", code != 0 and "half-5002" in said)
    check("its log says why", 'would meet the ground or the crop' in (results / "logs/half-5002.log").read_text())
    same(whole, results, [f"farms/{farm}.json" for farm in FARMS if farm.startswith("flat")])
    check("farms that fail leave nothing", not list((results / "farms").glob("half*")))
    said = trial.run("merge", results, exit_code=2)
    check(f"merge names what is missing: {said}", "3 of 6 farms have no result: half-5001, half-5002, half-5003" in said)
    trial.run("merge", results, "--finished")
    rows = [line for line in (whole / "table.csv").read_text().splitlines() if ",half," not in line]
    check("the table holds what is finished", (results / "table.csv").read_text().splitlines() == rows)


def a_cancelled_job_fails_and_is_run_again(trial, whole, suite):
    """The status script tells a job that Slurm ended from one that runs: Snakemake would wait for ever."""
    results = trial.plan(suite, "cancelled")
    running = trial.snakemake(results)
    while not trial.calls.read_text():
        check("the workflow runs until a job is cancelled", running.poll() is None)
        time.sleep(0.05)
    subprocess.run(["scancel", "--user=root", "--state=RUNNING"], env=trial.environment, check=True)
    check("the workflow ends with an error", running.wait(300) != 0)
    code, said = trial.finish(results)
    check(f"a second run does the rest: {said}", code == 0)
    same(whole, results, ["table.csv", "results.json"])


def trials(trial):
    suite = trial.suite("tiny")
    whole = trial.folder / "whole"
    trial.run("run", suite, "-o", whole, "-q")
    runs_as_on_one_machine(trial, whole, suite)
    shows_other_truths(trial, suite)
    goes_on_after_kill(trial, whole, suite)
    if trial.kind == "slurm":
        a_cancelled_job_fails_and_is_run_again(trial, whole, suite)
    a_sweep_shows_no_farm(trial)
    a_failing_farm_stops_no_other(trial, whole)


def lacking(kind):
    if shutil.which("snakemake") is None:
        return "snakemake is not installed (packages.txt, section cluster)"
    version = subprocess.run(["snakemake", "--version"], capture_output=True, text=True, check=True).stdout.strip()
    if not version.startswith("7."):
        return f"the profiles are for Snakemake 7, this is {version}"
    return slurm.missing() if kind == "slurm" else ""


def main(kind, farmbench, source):
    reason = lacking(kind)
    if reason:
        print(f"workflow: skipped: {reason}")
        return 77
    with tempfile.TemporaryDirectory(prefix="plotscan-") as folder:
        work = Path(folder)
        if kind == "local":
            trials(Trial(kind, farmbench, source, work, dict(os.environ)))
        else:
            with slurm.Slurm(work / "cluster") as environment:
                trials(Trial(kind, farmbench, source, work, environment))
    print(f"workflow: {kind}: as on one machine; other truths; killed and resumed; a sweep; failures reported")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], Path(sys.argv[3])))
