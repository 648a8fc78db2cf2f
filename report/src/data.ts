// What a report holds (docs/report-format.md), as the programs write it.

export interface Blob64 {
  blob: number; // the text of the element "blob-N" is its base64
}

export interface PackedNumbers {
  n: number;
  low: number;
  step: number;
  data: Blob64;
}

export interface Tile {
  n: number;
  at: number; // of its zlib stream in the blob, bytes
  bytes: number;
  low: [number, number, number];
  high: [number, number, number];
  step: number;
}

export type Attribute = "class" | "plot" | "intensity" | "time";

export interface Cloud {
  read: number;
  shown: number;
  origin: [number, number, number];
  time: [number, number];
  has: Attribute[];
  tiles: Tile[];
  data: Blob64;
}

export interface Grid {
  first: [number, number];
  cell: number;
  columns: number;
  rows: number;
  z: PackedNumbers;
  se?: PackedNumbers;
}

// Centre x, centre y, width, length (metres), heading (degrees).
export type Box = [number, number, number, number, number];

// Value, standard error, ends of the 95 % interval, metres.
export type Height = [number, number | null, number | null, number | null];

export interface Plot {
  id: string;
  trial?: number;
  row: number;
  column: number;
  box: Box;
  heights: Record<string, Height>;
  flags: string[];
  truths: Record<string, number | null>;
  state: "" | "found" | "extra";
  points?: number;
  confidence?: number;
}

export interface TrueBox {
  id: string;
  box: Box;
  found: boolean;
}

// The plane that a method took for the ground under a plot.
export interface Plane {
  id: string;
  box: Box;
  z: number; // at the box's centre
  slope: [number, number]; // rise to a metre east, to a metre north
  tolerance: number; // points no farther from it count as ground
}

// How a method came to its plots.
export interface Working {
  method: string;
  clusters: Box[]; // before the vote
  plots: Box[]; // after it
  planes: Plane[];
}

export interface Field {
  name: string;
  facts: [string, string][];
  notes: string[];
  path: [number, number, number][];
  plots: Plot[];
  true_boxes: TrueBox[];
  workings?: Working[];
  cloud?: Cloud;
  ground?: Grid;
  terrain?: Grid;
}

// A row of a suite's table; metres.
export interface TableRow {
  case: string;
  method: string;
  truth: string;
  named: boolean;
  shown: boolean;
  [column: string]: string | number | boolean | null;
}

// The estimates of one method's height, for every plot of the suite.
export interface Series {
  row: string; // "dhami2020/raw-p99"
  height: string; // "raw-p99"
  values: (number | null)[];
  low?: (number | null)[];
  high?: (number | null)[];
}

// What a suite asks whose cases are flights over one kind of farm.
export interface Sweep {
  axes: { key: string; values: (number | string)[] }[]; // case i is their combination i, the last varying fastest
  height: string;
  truth: string;
  row: string; // of the table: the first method's height
  goal?: { rmse_m: number; found: number };
  flights: { flight_s: number | null; points: number | null }[]; // a case; null: none was flown
}

export interface Suite {
  name: string;
  cases: { name: string; published_rmse_cm?: number }[];
  published?: { source: string; methods: string[] };
  baseline?: string; // the case that the others are compared with
  truths: string[]; // that are shown first
  farms: { case: string; seed: number; plot_numbers: (number | string)[] }[];
  plots: Record<string, (number | null)[]>; // the truths, by attribute; farm after farm
  series: Series[];
  table: TableRow[];
  boxes: TableRow[];
  sweep?: Sweep; // no plots and no series then
}

export interface Report {
  kind: "scan" | "estimate" | "suite";
  title: string;
  plotscan: string;
  fields: Field[];
  suite?: Suite;
}

export function readReport(): Report {
  const element = document.getElementById("report");
  if (!element) throw new Error("this is the empty template: the programs of Plotscan put a report into it");
  return JSON.parse(element.textContent ?? "") as Report;
}
