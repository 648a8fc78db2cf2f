// A box's own directions, and what lies where in it.
import type { Box } from "./data";

export interface Axes {
  along: (x: number, y: number) => number; // metres from the centre, along the length
  across: (x: number, y: number) => number;
  at: (along: number, across: number) => [number, number];
}

export function axesOf([x0, y0, , , heading]: Box): Axes {
  const [c, d] = [Math.cos((heading * Math.PI) / 180), Math.sin((heading * Math.PI) / 180)];
  return {
    along: (x, y) => (x - x0) * c + (y - y0) * d,
    across: (x, y) => (y - y0) * c - (x - x0) * d,
    at: (along, across) => [x0 + along * c - across * d, y0 + along * d + across * c],
  };
}

// Counter-clockwise.
export function corners(box: Box): [number, number][] {
  const [, , width, length] = box;
  const { at } = axesOf(box);
  return ([[-1, -1], [1, -1], [1, 1], [-1, 1]] as const).map(([u, v]) => at((u * length) / 2, (v * width) / 2));
}
