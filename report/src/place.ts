// Where things of a field stand in the scene: relative to the middle of what is first looked at, so that
// single precision suffices.
import * as THREE from "three";
import { corners } from "./boxes";
import type { Field, Plot } from "./data";
import type { Surface } from "./decode";
import { quantile } from "./numbers";

export interface Grounds {
  ground?: Surface;
  terrain?: Surface;
}

export interface Extent {
  low: THREE.Vector3;
  high: THREE.Vector3;
}

// Where a field without a ground lies: as its points' lower ends mostly do.
function levelOf({ cloud }: Field): number {
  const lows = (cloud?.tiles ?? []).map(({ low }) => low[2]).sort((a, b) => a - b);
  return cloud && lows.length > 0 ? cloud.origin[2] + quantile(lows, 0.5) : 0;
}

// What the camera first looks at: the plots, else the points, else the ground.
function extentOf(field: Field, grounds: Grounds): Extent {
  const box = new THREE.Box3();
  const surface = grounds.ground ?? grounds.terrain;
  const level = levelOf(field);
  for (const { box: plot } of [...field.plots, ...field.true_boxes])
    for (const [x, y] of corners(plot)) {
      const z = surface?.height(x, y) ?? NaN;
      box.expandByPoint(new THREE.Vector3(x, y, Number.isFinite(z) ? z : level));
    }
  if (box.isEmpty())
    for (const { low, high } of field.cloud?.tiles ?? [])
      for (const place of [low, high])
        box.expandByPoint(new THREE.Vector3(...place).add(new THREE.Vector3(...field.cloud!.origin)));
  if (box.isEmpty() && surface) {
    const { first, cell, columns, rows } = surface.grid;
    const z = surface.z.find((value) => Number.isFinite(value)) ?? 0;
    box.expandByPoint(new THREE.Vector3(first[0], first[1], z));
    box.expandByPoint(new THREE.Vector3(first[0] + cell * columns, first[1] + cell * rows, z));
  }
  if (box.isEmpty()) box.expandByPoint(new THREE.Vector3());
  return { low: box.min, high: box.max };
}

export class Place {
  readonly extent: Extent;
  readonly centre: THREE.Vector3;
  heightOf: (plot: Plot) => number = () => NaN;

  constructor(readonly field: Field, readonly grounds: Grounds) {
    this.extent = extentOf(field, grounds);
    this.centre = new THREE.Vector3().addVectors(this.extent.low, this.extent.high).multiplyScalar(0.5);
  }

  local(x: number, y: number, z: number): THREE.Vector3 {
    return new THREE.Vector3(x, y, z).sub(this.centre);
  }

  groundAt(x: number, y: number): number {
    for (const surface of [this.grounds.ground, this.grounds.terrain]) {
      const z = surface?.height(x, y) ?? NaN;
      if (Number.isFinite(z)) return z;
    }
    return this.extent.low.z;
  }

  // How tall a plot's box is drawn; 0 where it has no height.
  tall(plot: Plot): number {
    const height = this.heightOf(plot);
    return Number.isFinite(height) ? height : 0;
  }

  // Whether ground is drawn here: not far beyond the plots, or the points where there are none.
  isNear(x: number, y: number): boolean {
    const { low, high } = this.extent;
    const plots = this.field.plots.length + this.field.true_boxes.length;
    const reach = plots > 0 ? 6 + 0.15 * Math.max(high.x - low.x, high.y - low.y) : 1;
    return x > low.x - reach && x < high.x + reach && y > low.y - reach && y < high.y + reach;
  }

  // The nearest plot that a ray of the scene meets.
  hit(ray: THREE.Ray): Plot | undefined {
    let best: Plot | undefined;
    let nearest = Infinity;
    for (const plot of this.field.plots) {
      const [cx, cy, width, length, heading] = plot.box;
      const own = ray.clone();
      own.origin.sub(this.local(cx, cy, this.groundAt(cx, cy)));
      own.applyMatrix4(new THREE.Matrix4().makeRotationZ((-heading * Math.PI) / 180));
      const box = new THREE.Box3(
        new THREE.Vector3(-length / 2, -width / 2, -0.1), new THREE.Vector3(length / 2, width / 2, this.tall(plot) || 0.3));
      const met = own.intersectBox(box, new THREE.Vector3());
      const distance = met ? met.distanceTo(own.origin) : Infinity;
      if (distance < nearest) [best, nearest] = [plot, distance];
    }
    return best;
  }
}
