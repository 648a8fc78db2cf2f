// Points of a cloud on the graphics card: tiles that are drawn as far as the picture needs them.
import * as THREE from "three";
import type { Cloud } from "./data";
import { levelCounts, readTile, type TilePoints } from "./decode";

// A number of 0 to 255 for each point, and the colours of these numbers.
export interface Colouring {
  values: (points: TilePoints, put: (point: number, value: number) => void) => void;
  colours: Uint8Array; // 256 x RGBA
}

const vertexShader = `
precision highp float;
in vec4 position;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float pixels;   // of a metre at a distance of one
uniform float spacing;  // of the tile's points, metres
uniform float scale;
uniform sampler2D colours;
flat out vec3 colour;
void main() {
  vec4 seen = modelViewMatrix * vec4(position.xyz, 1.0);
  gl_Position = projectionMatrix * seen;
  gl_PointSize = clamp(scale * spacing * pixels / -seen.z, 1.0, 24.0);
  colour = texture(colours, vec2((position.w + 0.5) / 256.0, 0.5)).rgb;
}`;

const fragmentShader = `
precision highp float;
flat in vec3 colour;
out vec4 painted;
void main() {
  painted = vec4(colour, 1.0);
}`;

interface Drawn {
  points: TilePoints;
  object: THREE.Points<THREE.BufferGeometry, THREE.RawShaderMaterial>;
  attribute: THREE.BufferAttribute;
  counts: number[];
  footprint: number; // square metres
  centre: THREE.Vector3;
  radius: number;
}

export class PointCloud {
  readonly group = new THREE.Group();
  readonly read: TilePoints[] = [];
  shown = 0; // points in the last picture
  scale = 1;
  private tiles: Drawn[] = [];
  private colouring?: Colouring;
  private readonly texture = new THREE.DataTexture(new Uint8Array(1024), 256, 1);
  private readonly material: THREE.RawShaderMaterial;

  constructor(readonly cloud: Cloud, private readonly centre: THREE.Vector3) {
    this.material = new THREE.RawShaderMaterial({
      vertexShader, fragmentShader, glslVersion: THREE.GLSL3,
      uniforms: {
        pixels: { value: 1 }, spacing: { value: 1 }, scale: { value: 1 }, colours: { value: this.texture } },
    });
    this.texture.needsUpdate = true;
  }

  // Unpacks tile by tile, the coarse look of the whole as early as can be, and lets the page breathe.
  async load(more: (done: number) => void): Promise<void> {
    let done = 0;
    let breath = performance.now();
    for (const tile of this.cloud.tiles) {
      const points = await readTile(this.cloud, tile);
      this.add(points);
      done += tile.n;
      if (performance.now() - breath > 24) {
        more(done);
        await new Promise((resume) => setTimeout(resume, 0));
        breath = performance.now();
      }
    }
    more(done);
  }

  colour(colouring: Colouring): void {
    this.colouring = colouring;
    (this.texture.image.data as Uint8Array).set(colouring.colours);
    this.texture.needsUpdate = true;
    for (const tile of this.tiles) {
      this.paint(tile);
      tile.attribute.needsUpdate = true;
    }
  }

  private paint(tile: Drawn): void {
    const places = tile.points.places;
    this.colouring?.values(tile.points, (point, value) => {
      places[4 * point + 3] = value;
    });
  }

  private add(points: TilePoints): void {
    const { low, high, step, n } = points.tile;
    const attribute = new THREE.BufferAttribute(points.places, 4);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", attribute);
    const object = new THREE.Points(geometry, this.material);
    const corner = new THREE.Vector3(...low).add(new THREE.Vector3(...this.cloud.origin)).sub(this.centre);
    object.position.copy(corner);
    object.scale.setScalar(step);
    object.frustumCulled = false;
    const size = new THREE.Vector3(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    const tile: Drawn = {
      points, object, attribute, counts: levelCounts(n),
      footprint: Math.max(size.x * size.y, 1e-4),
      centre: corner.clone().addScaledVector(size, 0.5),
      radius: size.length() / 2,
    };
    object.onBeforeRender = () => {
      const uniforms = this.material.uniforms;
      uniforms.spacing.value = Math.sqrt(tile.footprint / Math.max(geometry.drawRange.count, 1));
      this.material.uniformsNeedUpdate = true;
    };
    this.paint(tile);
    this.tiles.push(tile);
    this.read.push(points);
    this.group.add(object);
  }

  // Chooses how much of each tile is drawn: what the screen resolves, `budget` points at most.
  choose(camera: THREE.PerspectiveCamera, height_px: number, budget: number): void {
    const pixels = height_px / (2 * Math.tan((camera.fov * Math.PI) / 360));
    this.material.uniforms.pixels.value = pixels;
    this.material.uniforms.scale.value = 1.5 * this.scale;
    const frustum = new THREE.Frustum().setFromProjectionMatrix(
      new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    const sphere = new THREE.Sphere();
    const wanted = this.tiles.map((tile) => {
      sphere.set(tile.centre, tile.radius);
      if (!frustum.intersectsSphere(sphere)) return 0;
      const distance = Math.max(camera.position.distanceTo(tile.centre) - tile.radius, 0.3);
      return Math.min(tile.points.tile.n, 2 * tile.footprint * (pixels / distance) ** 2);
    });
    const all = wanted.reduce((total, count) => total + count, 0);
    const share = Math.min(1, budget / Math.max(all, 1));
    this.shown = 0;
    this.tiles.forEach((tile, i) => {
      const most = wanted[i] * share * 1.42;
      const count = wanted[i] === 0 ? 0 : (tile.counts.findLast((level) => level <= most) ?? tile.counts[0]);
      tile.object.visible = count > 0;
      tile.object.geometry.setDrawRange(0, count);
      this.shown += count;
    });
  }

  dispose(): void {
    for (const tile of this.tiles) tile.object.geometry.dispose();
    this.material.dispose();
    this.texture.dispose();
  }
}
