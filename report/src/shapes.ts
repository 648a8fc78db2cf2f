// What stands in the scene besides the points.
import * as THREE from "three";
import { corners } from "./boxes";
import type { Box } from "./data";
import type { Surface } from "./decode";
import type { Place } from "./place";

// Ground whose standard error is larger is not drawn: it is made up.
const kUnsure_m = 0.06;
const kSteepest = 2; // rise over run of ground that is drawn
const kMostNodes = 40_000;

// A surface's mesh, as finely as it can be seen.
export function surfaceMesh(surface: Surface, place: Place, colour: string): THREE.Mesh {
  const { first, cell, columns, rows } = surface.grid;
  const stride = Math.max(1, Math.ceil(Math.sqrt((columns * rows) / kMostNodes)));
  const across = Math.floor((columns - 1) / stride) + 1;
  const up = Math.floor((rows - 1) / stride) + 1;
  const places = new Float32Array(3 * across * up);
  const known = new Uint8Array(across * up);
  for (let at = 0; at < across * up; ++at) {
    const [column, row] = [stride * (at % across), stride * Math.floor(at / across)];
    const [x, y, node] = [first[0] + cell * column, first[1] + cell * row, row * columns + column];
    const z = surface.z[node];
    known[at] = Number.isFinite(z) && (surface.se?.[node] ?? 0) < kUnsure_m && place.isNear(x, y) ? 1 : 0;
    place.local(x, y, known[at] ? z : 0).toArray(places, 3 * at);
  }
  const faces: number[] = [];
  for (let row = 0; row + 1 < up; ++row)
    for (let column = 0; column + 1 < across; ++column) {
      const a = row * across + column;
      const [b, c, d] = [a + 1, a + across, a + across + 1];
      if (!known[a] || !known[b] || !known[c] || !known[d]) continue;
      const heights = [a, b, c, d].map((node) => places[3 * node + 2]);
      if (Math.max(...heights) - Math.min(...heights) < kSteepest * cell * stride) faces.push(a, b, d, a, d, c);
    }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setIndex(faces);
  geometry.computeVertexNormals();
  return new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: colour, side: THREE.DoubleSide }));
}

// The edges of a box that stands on the ground, two places each; of its base alone where it has no height.
export function outline(place: Place, box: Box, height: number): THREE.Vector3[] {
  const base = corners(box).map(([x, y]) => place.local(x, y, place.groundAt(x, y)));
  const top = base.map((corner) => corner.clone().setZ(corner.z + height));
  const lines: THREE.Vector3[] = [];
  for (let i = 0; i < 4; ++i) {
    const next = (i + 1) % 4;
    lines.push(base[i], base[next]);
    if (height > 0) lines.push(top[i], top[next], base[i], top[i]);
  }
  return lines;
}

export function segments(places: THREE.Vector3[], colour: string, dashed = false): THREE.LineSegments {
  const geometry = new THREE.BufferGeometry().setFromPoints(places);
  const material = dashed
    ? new THREE.LineDashedMaterial({ color: colour, dashSize: 0.15, gapSize: 0.1 })
    : new THREE.LineBasicMaterial({ color: colour });
  const lines = new THREE.LineSegments(geometry, material);
  if (dashed) lines.computeLineDistances();
  return lines;
}

// Bars along the lines, as thick at any distance as the plots want.
export function bars(places: THREE.Vector3[], colour: string): THREE.Group {
  const bars = new THREE.Group();
  const material = new THREE.MeshBasicMaterial({ color: colour });
  for (let i = 0; i < places.length; i += 2) {
    const [from, to] = [places[i], places[i + 1]];
    const bar = new THREE.Mesh(new THREE.BoxGeometry(0.05, 0.05, from.distanceTo(to) + 0.05), material);
    bar.position.addVectors(from, to).multiplyScalar(0.5);
    bar.lookAt(to);
    bars.add(bar);
  }
  return bars;
}

export function pathLine(path: [number, number, number][], place: Place): THREE.Line {
  const geometry = new THREE.BufferGeometry().setFromPoints(path.map((stop) => place.local(...stop)));
  return new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: "#d55e00" }));
}
