// The columns of a field's table of plots.
import type { Field, Plot } from "./data";
import { heightNames } from "./heights";
import { measured, type Measure } from "./map";
import { fixed, namedTruth, truthName } from "./numbers";
import { centimetres, type Column } from "./table";

// A height with its interval and its error, as far as any plot has them.
function heightColumns({ plots }: Field, name: string): Column<Plot>[] {
  const columns: Column<Plot>[] = [
    { title: name, unit: "m", value: (plot) => plot.heights[name]?.[0], shown: (plot) => fixed(plot.heights[name]?.[0], 3) }];
  const some = (measure: Measure) => plots.some((plot) => Number.isFinite(measured(plot, measure, name)));
  const beside = (column: Column<Plot>) => columns.push({ ...column, csv: [[`${name} ${column.title} (cm)`, column.value]] });
  if (some("interval"))
    beside(centimetres("±", (plot) => measured(plot, "interval", name) / 2, { digits: 1, hint: `half the width of ${name}'s 95 % interval` }));
  if (some("error"))
    beside(centimetres("error", (plot) => measured(plot, "error", name), { digits: 1, sign: true, hint: `${name} minus ${truthName(namedTruth(name))}` }));
  return columns;
}

export function plotColumns(field: Field): Column<Plot>[] {
  const { plots } = field;
  const metres = (title: string, of: (plot: Plot) => number | null | undefined, digits: number): Column<Plot> =>
    ({ title, unit: "m", value: of, shown: (plot) => fixed(of(plot), digits) });
  const columns: Column<Plot>[] = [{ title: "plot", value: (plot) => plot.id }];
  if (plots.some((plot) => plot.trial)) columns.push({ title: "trial", value: (plot) => plot.trial });
  if (plots.some((plot) => plot.row > 0))
    columns.push({ title: "row", value: (plot) => plot.row }, { title: "column", value: (plot) => plot.column });
  const names = heightNames(field);
  columns.push(...names.flatMap((name) => heightColumns(field, name)));
  if (names.length === 0)
    for (const truth of new Set(plots.flatMap((plot) => Object.keys(plot.truths))))
      columns.push(metres(truthName(truth), (plot) => plot.truths[truth], 3));
  if (plots.some((plot) => plot.confidence !== undefined))
    columns.push({ title: "confidence", value: (plot) => plot.confidence, shown: (plot) => fixed(plot.confidence, 2) });
  columns.push(metres("length", (plot) => plot.box[3], 2), metres("width", (plot) => plot.box[2], 2));
  if (plots.some((plot) => plot.state)) columns.push({ title: "is", value: (plot) => (plot.state === "extra" ? "no plot" : "a plot") });
  if (plots.some((plot) => plot.flags.length)) columns.push({ title: "flags", value: (plot) => plot.flags.join("; ") });
  return columns;
}

// What the columns mean that are there.
export function plotNote(columns: Column<Plot>[]): string {
  const notes = [["error", "Errors are estimate minus truth."], ["±", "± is half the width of the 95 % interval."]];
  return notes.filter(([title]) => columns.some((column) => column.title === title)).map(([, note]) => note).join(" ");
}
