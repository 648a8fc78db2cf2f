// The columns of a suite's tables.
import type { Suite, TableRow } from "./data";
import { fixed } from "./numbers";
import { centimetres, intervalColumn, type Column } from "./table";

// Method by method in their order, a method's cases together.
export function byMethod(rows: TableRow[]): TableRow[] {
  const methods = [...new Set(rows.map((row) => row.method))];
  return methods.flatMap((method) => rows.filter((row) => row.method === method));
}

export const number = (row: TableRow, key: string): number => (typeof row[key] === "number" ? (row[key] as number) : NaN);

const cm = (title: string, key: string, hint?: string, sign = false): Column<TableRow> =>
  centimetres(title, (row) => number(row, key), { hint, sign });

const plain = (title: string, key: string, digits: number, hint?: string): Column<TableRow> =>
  ({ title, hint, value: (row) => number(row, key), shown: (row) => fixed(number(row, key), digits) });

const text = (title: string, key: string): Column<TableRow> => ({ title, value: (row) => String(row[key] ?? "") });

export function heightColumns(suite: Suite): Column<TableRow>[] {
  const columns: Column<TableRow>[] = [
    text("method", "method"), text("case", "case"), plain("plots", "plots", 0), plain("found", "found", 0),
    plain("without", "without", 0, "found plots without this height"),
    cm("RMSE", "rmse_m"), intervalColumn("RMSE", (row) => number(row, "rmse_low_m"), (row) => number(row, "rmse_high_m")),
  ];
  const { published } = suite;
  const publishedOf = (row: TableRow) => suite.cases.find(({ name }) => name === row.case)?.published_rmse_cm;
  if (published) columns.push({
    title: "published", unit: "cm", hint: published.source,
    value: (row) => (published.methods.includes(row.method) ? publishedOf(row) : undefined),
    shown: (row) => (published.methods.includes(row.method) ? fixed(publishedOf(row), 1) : "") });
  if (suite.table.some((row) => Number.isFinite(number(row, "rmse_change_m"))))
    columns.push(cm("change", "rmse_change_m", "RMSE minus the baseline case's, on the same farms", true));
  return [...columns,
    cm("bias", "bias_m", "mean of estimate minus truth", true), cm("MAE", "mae_m"), plain("R²", "r2", 2, "against the line estimate = truth"),
    cm("bias a farm", "farm_bias_m", "root mean square of the farms' own mean errors"),
    cm("within farms", "within_m", "root mean square of the errors less their farm's mean error"),
    plain("R² within", "r2_within", 2), plain("ρ within", "rho_within", 2, "Spearman's rank correlation within farms"),
    { title: "truths in 95 %", unit: "%", hint: "share of truths inside the method's own 95 % intervals", value: (row) => 100 * number(row, "coverage95"), shown: (row) => fixed(100 * number(row, "coverage95"), 1) },
    plain("flagged", "flagged", 0, "found plots with a flag that concerns this height"),
    plain("over 5 cm, no flag", "large_unflagged", 0, "found plots in error by more than 5 cm without a flag that concerns this height"),
    { ...plain("time", "seconds", 2, "median of the farms"), unit: "s" },
  ];
}

export const boxColumns: Column<TableRow>[] = [
  text("method", "method"), text("case", "case"), plain("plots", "plots", 0), plain("found", "found", 0), plain("missed", "missed", 0),
  plain("extra", "extra", 0, "estimated plots that are none"), plain("recall", "recall", 4), plain("precision", "precision", 4),
  plain("IoU mean", "iou_mean", 3, "intersection over union of the boxes"), plain("IoU least", "iou_min", 3),
  cm("centre", "center_rmse_m", "root mean square distance of the centres"),
  { title: "heading", unit: "°", value: (row) => number(row, "heading_rmse_deg"), shown: (row) => fixed(number(row, "heading_rmse_deg"), 3) },
];
