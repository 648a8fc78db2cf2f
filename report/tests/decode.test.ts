import { deflateSync } from "node:zlib";
import { describe, expect, it } from "vitest";
import type { Cloud, Tile } from "../src/data";
import { bytesOf, inflated, levelCounts, readDifferences, unpackedTile } from "../src/decode";

// As foundation/report/internal/packed.cpp writes them, from its description.
function differences(numbers: number[]): number[] {
  const folded = numbers.map((number, i) => {
    let difference = (number - (i ? numbers[i - 1] : 0)) & 65535;
    if (difference > 32767) difference -= 65536;
    return difference >= 0 ? 2 * difference : -2 * difference - 1;
  });
  return [...folded.map((number) => number & 255), ...folded.map((number) => number >> 8)];
}

describe("decode", () => {
  it("reads differences across the whole range", () => {
    const numbers = [0, 65535, 1, 32768, 32767, 65534, 0, 40000];
    const out = new Uint16Array(numbers.length);
    readDifferences(Uint8Array.from(differences(numbers)), 0, numbers.length, out);
    expect([...out]).toEqual(numbers);
  });

  it("reads base64 with and without padding", () => {
    expect([...bytesOf("AP8QIA==")]).toEqual([0, 255, 16, 32]);
    expect([...bytesOf("TWFu")]).toEqual([77, 97, 110]);
  });

  it("inflates zlib streams", async () => {
    const bytes = Uint8Array.from({ length: 5000 }, (_, i) => (i * i) % 251);
    expect(await inflated(new Uint8Array(deflateSync(bytes)))).toEqual(bytes);
  });

  it("unpacks a tile with all that it has", () => {
    const tile: Tile = { n: 3, at: 0, bytes: 0, low: [0, 0, 0], high: [1, 1, 1], step: 0.004 };
    const cloud: Cloud = {
      read: 3, shown: 3, origin: [0, 0, 0], time: [0, 1], has: ["class", "plot", "intensity", "time"], tiles: [tile], data: { blob: 0 } };
    const bytes = Uint8Array.from([
      ...differences([1, 2, 3]), ...differences([10, 20, 30]), ...differences([7, 6, 5]),
      1, 2, 0, 44, 0, 255, 1, 0, 255, 9, 8, 7, 0, 128, 255]);
    const points = unpackedTile(cloud, tile, bytes);
    expect([...points.places]).toEqual([1, 10, 7, 0, 2, 20, 6, 0, 3, 30, 5, 0]);
    expect([...points.labels!]).toEqual([1, 2, 0]);
    expect([...points.plots!]).toEqual([300, 0, 65535]);
    expect([...points.intensities!]).toEqual([9, 8, 7]);
    expect([...points.times!]).toEqual([0, 128, 255]);
  });

  it("knows how many points each level shows", () => {
    expect(levelCounts(200)).toEqual([200]);
    expect(levelCounts(1000)).toEqual([250, 500, 1000]);
    expect(levelCounts(32768)[0]).toBe(256);
  });
});
