// Pages as the programs make them: a small farm, its scan, an estimate in boxes with hostile ids, a suite.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const hostile = ["<script>document.title='hit'</script>", "\"><img src=x onerror=\"document.title='hit'\">", "'&amp;</script>"];

// Eight flights over the farm of a small suite, in another folder than the suite's own.
const sweep = (worlds) => `name: flights
farm: ${worlds}/paper_flat.yaml
set: {terrain.side_m: 30, terrain.vertices: 20, "plots.rows": "[{plots: 4}]", plants.count: 30}
axes: {altitude_m: [6, 12], speed_m_s: [3, 6], sensor: [vlp16, puck_hires]}
enough: {rmse_cm: 100, found: 1}
seeds: [1]
methods: [lattice true-boxes]
`;

export function makePages(programs, work) {
  rmSync(work, { recursive: true, force: true });
  mkdirSync(work, { recursive: true });
  const run = (program, ...words) => execFileSync(join(programs, program), words, { cwd: work, stdio: ["ignore", "ignore", "inherit"] });
  run("farmgen", "generate", "paper_half", "-o", "farm", "--seed", "5", "-q", ...[
    "terrain.side_m=30", "plots.rows.0.plots=3", "plots.rows.1.plots=3", "plots.rows.2.plots=3", "plants.count=40",
  ].flatMap((setting) => ["--set", setting]));
  const scan = hostile[1];
  const fewer = ["--points", "200000", "-q"];  // browsers without a GPU draw seconds longer at more
  run("lidarsim", "fly", "farm", "-o", scan, "-q");
  const map = JSON.parse(readFileSync(join(work, "farm/truth/plots.geojson"), "utf8"));
  map.features.forEach((feature, i) => {
    const id = hostile[i] ?? `P-${i + 1}`;
    feature.id = id;
    feature.properties = { plot_id: id };
  });
  writeFileSync(join(work, "map.geojson"), JSON.stringify(map));
  run("estimator", "run", scan, "--boxes", "map.geojson", "-o", "estimate", "-q");
  run("lidarsim", "view", scan, "--plots", "farm", "-o", "scan.html", ...fewer);
  run("estimator", "report", "estimate", "--truth", "farm", "--cloud", scan, "-o", "estimate.html", ...fewer);
  run("farmbench", "run", "smoke", "--methods", "lattice,dhami2020,dhami2020 true-boxes,oracle-ground", "-o", "suite", "-q");
  writeFileSync(join(work, "flights.yaml"), sweep(join(import.meta.dirname, "../../../worlds")));
  run("farmbench", "sweep", "flights.yaml", "-o", "sweep", "-q");
  for (const page of ["scan.html", "estimate.html", "suite/report.html", "sweep/report.html"])
    if (!existsSync(join(work, page))) throw new Error(`no ${page}`);
}
