// The columns of a sweep's table.
import type { Sweep } from "./data";
import { fixed } from "./numbers";
import { axisName, reaches, type Flight, type Goal } from "./sweep_data";
import { centimetres, intervalColumn, type Column } from "./table";

export function flightColumns(sweep: Sweep, goal: () => Goal): Column<Flight>[] {
  return [
    ...sweep.axes.map(({ key }, i): Column<Flight> => ({ title: axisName(key).name, unit: axisName(key).unit || undefined, value: (flight) => flight.values[i] })),
    centimetres("RMSE", (flight) => flight.rmse), intervalColumn("RMSE", (flight) => flight.low, (flight) => flight.high),
    centimetres("bias", (flight) => flight.bias, { sign: true }), centimetres("within fields", (flight) => flight.within),
    { title: "found", value: (flight) => flight.found, shown: (flight) => `${flight.found} of ${flight.plots}`,
      csv: [["found", (flight) => flight.found], ["plots", (flight) => flight.plots]] },
    { title: "extra", hint: "estimated plots that are none", value: (flight) => flight.extra },
    { title: "flight", unit: "s", hint: "time in the air over these plots, mean over farms", value: (flight) => flight.seconds, shown: (flight) => fixed(flight.seconds, 0) },
    { title: "points", unit: "million", value: (flight) => flight.points / 1e6, shown: (flight) => fixed(flight.points / 1e6, 2) },
    { title: "good enough", value: (flight) => (reaches(flight, goal()) ? "yes" : "no") },
  ];
}
