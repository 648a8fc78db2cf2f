// Values on a grid of uneven steps as bands and lines of equal value, bilinear between its nodes.

// Nodes in rows: values[row][column] at xs[column], ys[row], which rise. NaN: nothing is known there.
export interface Nodes {
  xs: number[];
  ys: number[];
  values: number[][];
}

export type Place = [number, number];

const kSteps = 60; // of a cell, each way

// Calls visit for the small squares that each cell is cut into, with their corners' values: those at
// (x0, y0), (x1, y0), (x1, y1), (x0, y1). Cells with an unknown corner are left out.
function eachSquare({ xs, ys, values }: Nodes, visit: (x: Place, y: Place, corners: number[]) => void): void {
  for (let row = 0; row + 1 < ys.length; ++row)
    for (let column = 0; column + 1 < xs.length; ++column) {
      const [a, b, c, d] = [values[row][column], values[row][column + 1], values[row + 1][column + 1], values[row + 1][column]];
      if (![a, b, c, d].every(Number.isFinite)) continue;
      const at = (u: number, v: number) => (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c);
      const x = (u: number) => xs[column] + u * (xs[column + 1] - xs[column]);
      const y = (v: number) => ys[row] + v * (ys[row + 1] - ys[row]);
      for (let j = 0; j < kSteps; ++j)
        for (let i = 0; i < kSteps; ++i) {
          const [u0, u1, v0, v1] = [i / kSteps, (i + 1) / kSteps, j / kSteps, (j + 1) / kSteps];
          visit([x(u0), x(u1)], [y(v0), y(v1)], [at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v1)]);
        }
    }
}

// The pieces of the line on which the value is `level`.
export function contourLines(nodes: Nodes, level: number): [Place, Place][] {
  const pieces: [Place, Place][] = [];
  eachSquare(nodes, ([x0, x1], [y0, y1], corners) => {
    const places: Place[] = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    const crossed: Place[] = [];
    for (let i = 0; i < 4; ++i) {
      const [from, to] = [corners[i], corners[(i + 1) % 4]];
      if (from < level === to < level) continue;
      const t = (level - from) / (to - from);
      const [p, q] = [places[i], places[(i + 1) % 4]];
      crossed.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
    }
    for (let i = 0; i + 1 < crossed.length; i += 2) pieces.push([crossed[i], crossed[i + 1]]);
  });
  return pieces;
}

// Which of the bands between levels a value lies in, from 0 below the first to their number above the last.
export const bandOf = (levels: number[], value: number): number => levels.filter((level) => value >= level).length;

// Rectangles x0, y0, x1, y1 of each band, runs of squares side by side in one.
export function bands(nodes: Nodes, levels: number[]): [number, number, number, number][][] {
  const all: [number, number, number, number][][] = Array.from({ length: levels.length + 1 }, () => []);
  eachSquare(nodes, ([x0, x1], [y0, y1], corners) => {
    const own = all[bandOf(levels, corners.reduce((sum, value) => sum + value, 0) / 4)];
    const last = own[own.length - 1];
    if (last && last[2] === x0 && last[1] === y0 && last[3] === y1) last[2] = x1;
    else own.push([x0, y0, x1, y1]);
  });
  return all;
}
