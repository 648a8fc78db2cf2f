// A field in three dimensions: points, ground, boxes, the drone's path. Drawn when something changes.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { PointCloud } from "./cloud";
import type { Field, Plot } from "./data";
import { flagsOf } from "./heights";
import { moveByKey } from "./keys";
import { Labels } from "./labels";
import { Pace } from "./pace";
import { Place, type Grounds } from "./place";
import { Shading } from "./shading";
import { bars, outline, pathLine, segments, surfaceMesh } from "./shapes";

export type Layer = "points" | "boxes" | "truth" | "ground" | "terrain" | "path" | "numbers";

export class Scene {
  readonly canvas: HTMLCanvasElement;
  readonly labels: Labels;
  cloud?: PointCloud;
  onPick: (plot: Plot | undefined) => void = () => {};
  private readonly renderer: THREE.WebGLRenderer;
  private readonly camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1000);
  private readonly controls: OrbitControls;
  private readonly points = new THREE.Scene();
  private readonly things = new THREE.Scene();
  private readonly shading = new Shading();
  private readonly place: Place;
  private readonly pace = new Pace();
  private readonly layers = new Map<Layer, THREE.Group>();
  private selected?: Plot;
  private frame = 0;
  private moving = false; // since the last picture
  private waiting = false; // and another one is wanted
  private rest = 0;
  private readonly size = new THREE.Vector2(1, 1);
  private sharp = true;
  private background = new THREE.Color("#ffffff");
  private ink = "#1c2128";

  constructor(private readonly field: Field, grounds: Grounds) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.autoClear = false;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.place = new Place(field, grounds);
    this.labels = new Labels(this.place);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.redraw(true));
    if (field.cloud) {
      this.cloud = new PointCloud(field.cloud, this.place.centre);
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
    if (grounds.ground) this.layers.get("ground")!.add(surfaceMesh(grounds.ground, this.place, "#6b5540"));
    if (grounds.terrain) this.layers.get("terrain")!.add(surfaceMesh(grounds.terrain, this.place, "#56b4e9"));
    if (field.path.length > 1) this.layers.get("path")!.add(pathLine(field.path, this.place));
    this.listen();
    this.look("overview");
  }

  // Sets where the camera stands: from the south, above, or near the selected plot.
  look(from: "overview" | "top" | "plot"): void {
    const size = new THREE.Vector3().subVectors(this.place.extent.high, this.place.extent.low);
    const aspect = Math.max(this.camera.aspect, 0.4);
    let reach = Math.max(size.y * 0.9, size.x / aspect, 4) * 1.32;
    this.controls.target.set(0, -0.05 * size.y, 0);
    if (from === "plot" && this.selected) {
      const [x, y, width, length] = this.selected.box;
      this.controls.target.copy(this.place.local(x, y, this.place.groundAt(x, y) + 0.3));
      reach = 2.2 * Math.max(width, length);
    }
    const distance = reach / (2 * Math.tan((this.camera.fov * Math.PI) / 360));
    const away = from === "top" ? new THREE.Vector3(0, -0.001, 1) : new THREE.Vector3(-0.28, -0.76, 0.58);
    this.camera.position.copy(this.controls.target).addScaledVector(away.normalize(), distance);
    this.controls.update();
    this.redraw();
  }

  show(layer: Layer, visible: boolean): void {
    if (layer === "numbers") this.labels.overlay.hidden = !visible;
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
    this.place.heightOf = heightOf;
    this.selected = selected;
    this.addBoxes();
  }

  // Draws soon: while the camera moves as much as stays smooth, else, and once it rests, all that the screen
  // resolves in a moment.
  redraw(moving = false): void {
    this.moving ||= moving;
    if (this.frame) return;
    if (this.pace.busy) {
      this.waiting = true;
      return;
    }
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.sharpen(!(this.moving && this.pace.slow));
      this.render(this.pace.budget(this.moving), this.moving);
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
    // Once more: the other target has another colour space.
    this.renderer.setClearColor(this.background, 1);
    this.renderer.clear();
    if (this.cloud && this.points.visible) this.shading.draw(this.renderer, this.camera);
    this.renderer.render(this.things, this.camera);
    this.labels.follow(this.camera, this.canvas);
    this.pace.measure(
      this.renderer.getContext() as WebGL2RenderingContext,
      { start, points: this.cloud?.shown ?? 0, moving, sharp: this.sharp },
      () => {
        if (!this.waiting) return;
        this.waiting = false;
        this.redraw();
      });
  }

  private addBoxes(): void {
    const boxes = this.layers.get("boxes")!;
    const truth = this.layers.get("truth")!;
    for (const group of [boxes, truth]) {
      group.traverse((object) => (object as THREE.Mesh).geometry?.dispose());
      group.clear();
    }
    const { place, field, selected } = this;
    const kinds = new Map<string, THREE.Vector3[]>();
    for (const plot of field.plots) {
      const colour = plot.state === "extra" ? "#cc79a7" : flagsOf(plot).length > 0 ? "#d55e00" : this.ink;
      if (!kinds.has(colour)) kinds.set(colour, []);
      kinds.get(colour)!.push(...outline(place, plot.box, place.tall(plot)));
    }
    for (const [colour, lines] of kinds) boxes.add(segments(lines, colour));
    if (selected) boxes.add(bars(outline(place, selected.box, place.tall(selected)), "#e69f00"));
    const known = field.true_boxes.flatMap((plot) => outline(place, plot.box, 0));
    if (known.length > 0) truth.add(segments(known, "#0072b2", true));
    this.labels.write(selected);
    this.redraw();
  }

  // The nearest plot under a place of the canvas, -1 to 1.
  private pick(x: number, y: number): Plot | undefined {
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(x, y), this.camera);
    return this.place.hit(caster.ray);
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
    this.canvas.addEventListener("keydown", (event) => moveByKey(event, this.controls) && this.redraw(true));
  }
}
