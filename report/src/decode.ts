// Numbers and clouds as foundation/report packs them, unpacked.
import type { Blob64, Cloud, Grid, PackedNumbers, Tile } from "./data";

interface FromBase64 {
  fromBase64?: (text: string) => Uint8Array<ArrayBuffer>;
}

export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const own = (Uint8Array as FromBase64).fromBase64;
  if (own) return own.call(Uint8Array, base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const texts = new Map<number, string>();

// The text of a blob; its element is emptied, so that it is held once.
function blobText(blob: Blob64): string {
  let text = texts.get(blob.blob);
  if (text === undefined) {
    const element = document.getElementById(`blob-${blob.blob}`);
    text = element?.textContent ?? "";
    element?.remove();
    texts.set(blob.blob, text);
  }
  return text;
}

export async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The inverse of append_differences: n numbers from the bytes at `at`, written to every `stride`th place.
export function readDifferences(
  bytes: Uint8Array, at: number, n: number, out: Uint16Array, first = 0, stride = 1): void {
  let last = 0;
  for (let i = 0, to = first; i < n; ++i, to += stride) {
    const folded = bytes[at + i] | (bytes[at + n + i] << 8);
    last = (last + ((folded >>> 1) ^ -(folded & 1))) & 65535;
    out[to] = last;
  }
}

export async function unpackedNumbers(packed: PackedNumbers): Promise<Float32Array> {
  const bytes = await inflated(bytesOf(blobText(packed.data)));
  const whole = new Uint16Array(packed.n);
  readDifferences(bytes, 0, packed.n, whole);
  return Float32Array.from(whole, (number) => (number === 65535 ? NaN : packed.low + packed.step * number));
}

// How many points of a tile of n its level k shows, coarsest first.
export function levelCounts(n: number): number[] {
  let levels = 0;
  while (n >> levels > 256) ++levels;
  const counts: number[] = [];
  for (let k = levels; k >= 0; --k) counts.push(Math.ceil(n / 2 ** k));
  return counts;
}

// A tile's points: x, y, z in steps from its low corner and, as a fourth, a number for the colour.
export interface TilePoints {
  tile: Tile;
  places: Uint16Array; // 4 a point
  labels?: Uint8Array;
  plots?: Uint16Array;
  intensities?: Uint8Array;
  times?: Uint8Array;
}

export function unpackedTile(cloud: Cloud, tile: Tile, bytes: Uint8Array): TilePoints {
  const n = tile.n;
  const points: TilePoints = { tile, places: new Uint16Array(4 * n) };
  for (let axis = 0; axis < 3; ++axis) readDifferences(bytes, 2 * n * axis, n, points.places, axis, 4);
  let at = 6 * n;
  const next = () => bytes.subarray(at, (at += n));
  if (cloud.has.includes("class")) points.labels = next();
  if (cloud.has.includes("plot")) {
    const low = next();
    const high = next();
    points.plots = Uint16Array.from(low, (byte, i) => byte | (high[i] << 8));
  }
  if (cloud.has.includes("intensity")) points.intensities = next();
  if (cloud.has.includes("time")) points.times = next();
  return points;
}

export async function readTile(cloud: Cloud, tile: Tile): Promise<TilePoints> {
  const from = (tile.at / 3) * 4;
  const text = blobText(cloud.data).slice(from, from + Math.ceil(tile.bytes / 3) * 4);
  return unpackedTile(cloud, tile, await inflated(bytesOf(text).subarray(0, tile.bytes)));
}

// The heights of a grid's nodes, bilinear between them; NaN where there are none.
export class Surface {
  private constructor(
    readonly grid: Grid, readonly z: Float32Array, readonly se?: Float32Array) {}

  static async of(grid: Grid): Promise<Surface> {
    return new Surface(grid, await unpackedNumbers(grid.z), grid.se && (await unpackedNumbers(grid.se)));
  }

  height(x: number, y: number): number {
    return this.between(this.z, x, y);
  }

  standardError(x: number, y: number): number {
    return this.se ? this.between(this.se, x, y) : NaN;
  }

  private between(values: Float32Array, x: number, y: number): number {
    const { first, cell, columns, rows } = this.grid;
    const u = (x - first[0]) / cell;
    const v = (y - first[1]) / cell;
    if (!(u >= 0 && v >= 0 && u <= columns - 1 && v <= rows - 1)) return NaN;
    const column = Math.min(Math.floor(u), columns - 2);
    const row = Math.min(Math.floor(v), rows - 2);
    const at = row * columns + column;
    const s = u - column;
    const t = v - row;
    return (
      (1 - t) * ((1 - s) * values[at] + s * values[at + 1]) +
      t * ((1 - s) * values[at + columns] + s * values[at + columns + 1]));
  }
}
