// Eye-dome lighting: points that lie behind their neighbours on the screen are darker, so that shape
// shows without normals (C. Boucheny's thesis, 2009; VTK has it as vtkEDLShading). Colours and depths come from a picture of the
// points alone; depths are handed on, so that what is drawn afterwards stands among the points.
import * as THREE from "three";

const vertexShader = `
in vec3 position;
out vec2 at;
void main() {
  at = position.xy * 0.5 + 0.5;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

const fragmentShader = `
precision highp float;
in vec2 at;
out vec4 painted;
uniform sampler2D colours, depths;
uniform vec2 pixel;
uniform float near, far, strength;
float range(vec2 place) {
  float depth = texture(depths, place).r;
  return depth >= 1.0 ? far : near * far / (far - depth * (far - near));
}
void main() {
  float depth = texture(depths, at).r;
  if (depth >= 1.0) discard;
  float own = log2(range(at));
  float behind = 0.0;
  for (int i = 0; i < 8; ++i) {
    float angle = 0.785398 * float(i);
    behind += max(0.0, own - log2(range(at + pixel * vec2(cos(angle), sin(angle)))));
  }
  float shade = exp(-strength * behind / 8.0);
  painted = vec4(texture(colours, at).rgb * max(shade, 0.25), 1.0);
  gl_FragDepth = depth;
}`;

export class Shading {
  readonly target: THREE.WebGLRenderTarget;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private readonly material: THREE.RawShaderMaterial;

  constructor() {
    this.target = new THREE.WebGLRenderTarget(1, 1, {
      minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, depthTexture: new THREE.DepthTexture(1, 1),
    });
    this.target.depthTexture!.type = THREE.UnsignedIntType;
    this.material = new THREE.RawShaderMaterial({
      vertexShader, fragmentShader, glslVersion: THREE.GLSL3,
      uniforms: {
        colours: { value: this.target.texture }, depths: { value: this.target.depthTexture },
        pixel: { value: new THREE.Vector2() }, near: { value: 0.1 }, far: { value: 1000 }, strength: { value: 40 },
      },
    });
    const triangle = new THREE.BufferGeometry();
    triangle.setAttribute("position", new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    const mesh = new THREE.Mesh(triangle, this.material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }

  resize(width: number, height: number, ratio: number): void {
    this.target.setSize(width, height);
    this.material.uniforms.pixel.value.set((1.2 * ratio) / width, (1.2 * ratio) / height);
  }

  draw(renderer: THREE.WebGLRenderer, camera: THREE.PerspectiveCamera): void {
    this.material.uniforms.near.value = camera.near;
    this.material.uniforms.far.value = camera.far;
    renderer.render(this.scene, this.camera);
  }

  dispose(): void {
    this.target.depthTexture?.dispose();
    this.target.dispose();
    this.material.dispose();
  }
}
