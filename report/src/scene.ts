// A field in three dimensions: points, ground, boxes, the drone's path. Drawn when something changes.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { PointCloud } from "./cloud";
import type { Box, Field, Plot } from "./data";
import type { Surface } from "./decode";
import { Shading } from "./shading";

export type Layer = "points" | "boxes" | "truth" | "ground" | "terrain" | "path" | "numbers";

// Ground whose standard error is larger is not drawn: it is made up.
const kUnsure_m = 0.06;

export interface Grounds {
  ground?: Surface;
  terrain?: Surface;
}

// Corners of a box, counter-clockwise.
export function corners([x, y, width, length, heading]: Box): [number, number][] {
  const along = [Math.cos((heading * Math.PI) / 180), Math.sin((heading * Math.PI) / 180)];
  return ([[-1, -1], [1, -1], [1, 1], [-1, 1]] as const).map(([u, v]) => [
    x + (u * length * along[0] - v * width * along[1]) / 2,
    y + (u * length * along[1] + v * width * along[0]) / 2,
  ]);
}

interface Extent {
  low: THREE.Vector3;
  high: THREE.Vector3;
}

// What the camera first looks at: the plots, else the points, else the ground.
function extentOf(field: Field, grounds: Grounds): Extent {
  const box = new THREE.Box3();
  const surface = grounds.ground ?? grounds.terrain;
  for (const { box: plot } of [...field.plots, ...field.true_boxes])
    for (const [x, y] of corners(plot)) {
      const z = surface?.height(x, y) ?? NaN;
      box.expandByPoint(new THREE.Vector3(x, y, Number.isFinite(z) ? z : (field.cloud?.tiles[0]?.low[2] ?? 0)));
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

export class Scene {
  readonly canvas: HTMLCanvasElement;
  readonly overlay = document.createElement("div");
  cloud?: PointCloud;
  onPick: (plot: Plot | undefined) => void = () => {};
  private readonly renderer: THREE.WebGLRenderer;
  private readonly camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1000);
  private readonly controls: OrbitControls;
  private readonly points = new THREE.Scene();
  private readonly things = new THREE.Scene();
  private readonly shading = new Shading();
  private readonly centre = new THREE.Vector3();
  private readonly extent: Extent;
  private readonly layers = new Map<Layer, THREE.Group>();
  private labels: { element: HTMLElement; place: THREE.Vector3 }[] = [];
  private selected?: Plot;
  private heightOf: (plot: Plot) => number = () => NaN;
  private frame = 0;
  private busy = false; // the last picture is still being drawn
  private moving = false; // since the last picture
  private waiting = false; // and another one is wanted
  private rest = 0;
  private readonly size = new THREE.Vector2(1, 1);
  private sharp = true;
  private slow = false; // a sharp picture takes too long for a moving camera
  private speed = 20_000; // points a millisecond, as measured
  private background = new THREE.Color("#ffffff");
  private ink = "#1c2128";

  constructor(private readonly field: Field, private readonly grounds: Grounds) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.autoClear = false;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.overlay.className = "labels";
    this.extent = extentOf(field, grounds);
    this.centre.addVectors(this.extent.low, this.extent.high).multiplyScalar(0.5);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.redraw(true));
    if (field.cloud) {
      this.cloud = new PointCloud(field.cloud, this.centre);
      this.points.add(this.cloud.group);
    }
    this.things.add(new THREE.HemisphereLight("#ffffff", "#7a6a55", 2.4));
    const sun = new THREE.DirectionalLight("#ffffff", 1.4);
    sun.position.set(-0.6, -0.3, 0.7);
    this.things.add(sun);
    for (const layer of ["boxes", "truth", "ground", "terrain", "path"] as Layer[]) {
      const group = new THREE.Group();
      this.layers.set(layer, group);
      this.things.add(group);
    }
    this.addSurface("ground", grounds.ground, "#6b5540");
    this.addSurface("terrain", grounds.terrain, "#56b4e9");
    this.addPath();
    this.listen();
    this.look("overview");
  }

  // Sets where the camera stands: from the south, above, or near the selected plot.
  look(from: "overview" | "top" | "plot"): void {
    const size = new THREE.Vector3().subVectors(this.extent.high, this.extent.low);
    const aspect = Math.max(this.camera.aspect, 0.4);
    let reach = Math.max(size.y * 0.9, size.x / aspect, 4) * 1.32;
    this.controls.target.set(0, -0.05 * size.y, 0);
    if (from === "plot" && this.selected) {
      const [x, y, width, length] = this.selected.box;
      this.controls.target.copy(this.local(x, y, this.groundAt(x, y) + 0.3));
      reach = 2.2 * Math.max(width, length);
    }
    const distance = reach / (2 * Math.tan((this.camera.fov * Math.PI) / 360));
    const away = from === "top" ? new THREE.Vector3(0, -0.001, 1) : new THREE.Vector3(-0.28, -0.76, 0.58);
    this.camera.position.copy(this.controls.target).addScaledVector(away.normalize(), distance);
    this.controls.update();
    this.redraw();
  }

  show(layer: Layer, visible: boolean): void {
    if (layer === "numbers") this.overlay.hidden = !visible;
    else if (layer === "points") this.points.visible = visible;
    else this.layers.get(layer)!.visible = visible;
    this.redraw();
  }

  colours(background: string, ink: string): void {
    this.background = new THREE.Color(background);
    this.ink = ink;
    this.addBoxes();
  }

  // Boxes as tall as `heightOf` says, the selected plot's in bold.
  plots(heightOf: (plot: Plot) => number, selected?: Plot): void {
    this.heightOf = heightOf;
    this.selected = selected;
    this.addBoxes();
  }

  // Draws soon: while the camera moves as much as stays smooth, else, and once it rests, all that the screen
  // resolves in a moment.
  redraw(moving = false): void {
    this.moving ||= moving;
    if (this.frame) return;
    if (this.busy) {
      this.waiting = true;
      return;
    }
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      const full = Math.max(this.speed * 500, 600_000);
      this.sharpen(!(this.moving && this.slow));
      this.render(this.moving ? Math.max(this.speed * 40, 60_000) : full, this.moving);
      clearTimeout(this.rest);
      if (this.moving) this.rest = window.setTimeout(() => this.redraw(), 180);
      this.moving = false;
    });
  }

  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    const before = this.camera.aspect;
    this.size.set(width, height);
    this.setSize();
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (before === 1) this.look("overview");
    this.redraw();
  }

  // Where pictures take long, those of a moving camera are coarser.
  private sharpen(sharp: boolean): void {
    if (sharp === this.sharp) return;
    this.sharp = sharp;
    this.setSize();
  }

  private setSize(): void {
    const ratio = Math.min(window.devicePixelRatio, 2) * (this.sharp ? 1 : 0.5);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.size.x, this.size.y, false);
    this.shading.resize(Math.round(this.size.x * ratio), Math.round(this.size.y * ratio), ratio);
  }

  // The picture as it stands, with every point that the screen resolves.
  async png(): Promise<Blob> {
    this.sharpen(true);
    this.render(5_000_000);
    return new Promise((done, failed) =>
      this.canvas.toBlob((blob) => (blob ? done(blob) : failed(new Error("no picture"))), "image/png"));
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    clearTimeout(this.rest);
    this.cloud?.dispose();
    this.shading.dispose();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private local(x: number, y: number, z: number): THREE.Vector3 {
    return new THREE.Vector3(x, y, z).sub(this.centre);
  }

  private groundAt(x: number, y: number): number {
    for (const surface of [this.grounds.ground, this.grounds.terrain]) {
      const z = surface?.height(x, y) ?? NaN;
      if (Number.isFinite(z)) return z;
    }
    return this.extent.low.z;
  }

  private render(budget: number, moving = false): void {
    const start = performance.now();
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(distance / 200, 0.05);
    this.camera.far = distance * 20 + 200;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.renderer.setClearColor(this.background, 1);
    if (this.cloud && this.points.visible) {
      this.cloud.choose(this.camera, size.y, budget);
      this.renderer.setRenderTarget(this.shading.target);
      this.renderer.clear();
      this.renderer.render(this.points, this.camera);
    }
    this.renderer.setRenderTarget(null);
    this.renderer.clear();
    if (this.cloud && this.points.visible) this.shading.draw(this.renderer, this.camera);
    this.renderer.render(this.things, this.camera);
    this.measure(start, moving);
    this.placeLabels();
  }

  // How fast points are drawn here, so that moving stays smooth on any machine.
  private measure(start: number, moving: boolean): void {
    const drawn = this.cloud?.shown ?? 0;
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!fence) return;
    gl.flush();
    this.busy = true;
    const { sharp } = this;
    const poll = () => {
      const done = gl.isContextLost() || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED;
      if (!done && performance.now() - start < 4000) {
        setTimeout(poll, 3);
        return;
      }
      gl.deleteSync(fence);
      this.busy = false;
      const spent = performance.now() - start;
      if (moving && sharp && spent > 40) this.slow = true;
      if (moving && !sharp && spent < 8) this.slow = false;
      if (drawn > 30_000) this.speed = 0.6 * this.speed + 0.4 * (drawn / Math.max(spent, 1));
      if (this.waiting) {
        this.waiting = false;
        this.redraw();
      }
    };
    setTimeout(poll, 3);
  }

  // Whether ground is drawn here: not far beyond the plots, where nothing is measured on it.
  private isNear(x: number, y: number): boolean {
    if (this.field.plots.length + this.field.true_boxes.length === 0) return true;
    const { low, high } = this.extent;
    const reach = 6 + 0.15 * Math.max(high.x - low.x, high.y - low.y);
    return x > low.x - reach && x < high.x + reach && y > low.y - reach && y < high.y + reach;
  }

  private addSurface(layer: Layer, surface: Surface | undefined, colour: string): void {
    if (!surface) return;
    const { first, cell, columns, rows } = surface.grid;
    const stride = Math.max(1, Math.ceil(Math.sqrt((columns * rows) / 40_000)));
    const across = Math.floor((columns - 1) / stride) + 1;
    const up = Math.floor((rows - 1) / stride) + 1;
    const places = new Float32Array(3 * across * up);
    const known = new Uint8Array(across * up);
    for (let row = 0; row < up; ++row)
      for (let column = 0; column < across; ++column) {
        const z = surface.z[row * stride * columns + column * stride];
        const at = row * across + column;
        const [x, y] = [first[0] + cell * stride * column, first[1] + cell * stride * row];
        const error = surface.se?.[row * stride * columns + column * stride] ?? 0;
        known[at] = Number.isFinite(z) && error < kUnsure_m && this.isNear(x, y) ? 1 : 0;
        const place = this.local(x, y, known[at] ? z : 0);
        place.toArray(places, 3 * at);
      }
    const faces: number[] = [];
    for (let row = 0; row + 1 < up; ++row)
      for (let column = 0; column + 1 < across; ++column) {
        const a = row * across + column;
        const [b, c, d] = [a + 1, a + across, a + across + 1];
        if (known[a] && known[b] && known[c] && known[d]) faces.push(a, b, d, a, d, c);
      }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
    geometry.setIndex(faces);
    geometry.computeVertexNormals();
    const material = new THREE.MeshLambertMaterial({ color: colour, side: THREE.DoubleSide });
    this.layers.get(layer)!.add(new THREE.Mesh(geometry, material));
  }

  private addPath(): void {
    if (this.field.path.length < 2) return;
    const places = this.field.path.map((place) => this.local(...place));
    const geometry = new THREE.BufferGeometry().setFromPoints(places);
    this.layers.get("path")!.add(new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: "#d55e00" })));
  }

  private outline(box: Box, height: number): THREE.Vector3[] {
    const base = corners(box).map(([x, y]) => this.local(x, y, this.groundAt(x, y)));
    const top = base.map((place) => place.clone().setZ(place.z + height));
    const lines: THREE.Vector3[] = [];
    for (let i = 0; i < 4; ++i) {
      const next = (i + 1) % 4;
      lines.push(base[i], base[next]);
      if (height > 0) lines.push(top[i], top[next], base[i], top[i]);
    }
    return lines;
  }

  private lines(places: THREE.Vector3[], colour: string, dashed = false): THREE.LineSegments {
    const geometry = new THREE.BufferGeometry().setFromPoints(places);
    const material = dashed
      ? new THREE.LineDashedMaterial({ color: colour, dashSize: 0.15, gapSize: 0.1 })
      : new THREE.LineBasicMaterial({ color: colour });
    const lines = new THREE.LineSegments(geometry, material);
    if (dashed) lines.computeLineDistances();
    return lines;
  }

  // Bars along the lines, as thick at any distance as the plots want.
  private bars(places: THREE.Vector3[], colour: string): THREE.Group {
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

  private addBoxes(): void {
    const boxes = this.layers.get("boxes")!;
    const truth = this.layers.get("truth")!;
    for (const group of [boxes, truth]) {
      group.traverse((object) => (object as THREE.Mesh).geometry?.dispose());
      group.clear();
    }
    const kinds = new Map<string, THREE.Vector3[]>();
    for (const plot of this.field.plots) {
      const height = this.heightOf(plot);
      const colour = plot.state === "extra" ? "#cc79a7" : plot.flags.length > 0 ? "#d55e00" : this.ink;
      const lines = this.outline(plot.box, Number.isFinite(height) ? height : 0);
      kinds.set(colour, [...(kinds.get(colour) ?? []), ...lines]);
    }
    for (const [colour, lines] of kinds) boxes.add(this.lines(lines, colour));
    if (this.selected) {
      const height = this.heightOf(this.selected);
      boxes.add(this.bars(this.outline(this.selected.box, Number.isFinite(height) ? height : 0), "#e69f00"));
    }
    const known = this.field.true_boxes.flatMap((plot) => this.outline(plot.box, 0));
    if (known.length > 0) truth.add(this.lines(known, "#0072b2", true));
    this.addLabels();
    this.redraw();
  }

  private addLabels(): void {
    const most = 120;
    const plots = this.field.plots.length <= most ? this.field.plots : this.selected ? [this.selected] : [];
    this.labels = plots.map((plot) => {
      const [x, y] = plot.box;
      const height = this.heightOf(plot);
      const element = document.createElement("span");
      element.textContent = plot.id.length > 14 ? plot.id.slice(0, 13) + "…" : plot.id;
      if (plot === this.selected) element.className = "selected";
      return { element, place: this.local(x, y, this.groundAt(x, y) + (Number.isFinite(height) ? height : 0) + 0.15) };
    });
    this.overlay.replaceChildren(...this.labels.map((label) => label.element));
  }

  private placeLabels(): void {
    if (this.overlay.hidden) return;
    const { clientWidth, clientHeight } = this.canvas;
    for (const { element, place } of this.labels) {
      const seen = place.clone().project(this.camera);
      const visible = Math.abs(seen.x) < 1 && Math.abs(seen.y) < 1 && seen.z < 1;
      element.hidden = !visible;
      if (visible)
        element.style.transform =
          `translate(${((seen.x + 1) / 2) * clientWidth}px, ${((1 - seen.y) / 2) * clientHeight}px) translate(-50%, -100%)`;
    }
  }

  // The nearest plot under a place of the canvas, -1 to 1.
  pick(x: number, y: number): Plot | undefined {
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(x, y), this.camera);
    let best: Plot | undefined;
    let nearest = Infinity;
    for (const plot of this.field.plots) {
      const [cx, cy, width, length, heading] = plot.box;
      const height = this.heightOf(plot);
      const turn = new THREE.Matrix4().makeRotationZ((-heading * Math.PI) / 180);
      const ray = caster.ray.clone();
      ray.origin.sub(this.local(cx, cy, this.groundAt(cx, cy)));
      ray.applyMatrix4(turn);
      const box = new THREE.Box3(
        new THREE.Vector3(-length / 2, -width / 2, -0.1),
        new THREE.Vector3(length / 2, width / 2, Number.isFinite(height) ? height : 0.3));
      const hit = ray.intersectBox(box, new THREE.Vector3());
      const distance = hit ? hit.distanceTo(ray.origin) : Infinity;
      if (distance < nearest) [best, nearest] = [plot, distance];
    }
    return best;
  }

  private listen(): void {
    let from: [number, number] = [0, 0];
    this.canvas.addEventListener("pointerdown", (event) => (from = [event.clientX, event.clientY]));
    this.canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - from[0], event.clientY - from[1]) > 5) return;
      const frame = this.canvas.getBoundingClientRect();
      this.onPick(this.pick(
        ((event.clientX - frame.left) / frame.width) * 2 - 1, 1 - ((event.clientY - frame.top) / frame.height) * 2));
    });
    this.canvas.addEventListener("keydown", (event) => this.turn(event));
  }

  // Arrows turn, + and - come nearer and go away, with Shift the arrows move.
  private turn(event: KeyboardEvent): void {
    const steps: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const step = steps[event.key];
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (step && event.shiftKey) {
      const move = new THREE.Vector3(step[0], step[1], 0).applyAxisAngle(
        new THREE.Vector3(0, 0, 1), Math.atan2(offset.y, offset.x) + Math.PI / 2);
      move.multiplyScalar(offset.length() / 20);
      this.controls.target.add(move);
      this.camera.position.add(move);
    } else if (step) {
      const sphere = new THREE.Spherical().setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));
      sphere.theta += 0.1 * step[0];
      sphere.phi = Math.min(Math.max(sphere.phi - 0.08 * step[1], 0.02), this.controls.maxPolarAngle);
      const turned = new THREE.Vector3().setFromSpherical(sphere);
      this.camera.position.copy(this.controls.target).add(new THREE.Vector3(turned.x, -turned.z, turned.y));
    } else if (event.key === "+" || event.key === "=" || event.key === "-") {
      offset.multiplyScalar(event.key === "-" ? 1.15 : 1 / 1.15);
      this.camera.position.copy(this.controls.target).add(offset);
    } else {
      return;
    }
    event.preventDefault();
    this.controls.update();
    this.redraw(true);
  }
}
