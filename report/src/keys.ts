// The camera by the keyboard.
import * as THREE from "three";
import type { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

// Arrows turn, + and - come nearer and go away, with Shift the arrows move. Whether the key was one of these.
export function moveByKey(event: KeyboardEvent, controls: OrbitControls): boolean {
  const camera = controls.object;
  const steps: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const step = steps[event.key];
  const offset = camera.position.clone().sub(controls.target);
  if (step && event.shiftKey) {
    const move = new THREE.Vector3(step[0], step[1], 0).applyAxisAngle(
      new THREE.Vector3(0, 0, 1), Math.atan2(offset.y, offset.x) + Math.PI / 2);
    move.multiplyScalar(offset.length() / 20);
    controls.target.add(move);
    camera.position.add(move);
  } else if (step) {
    const sphere = new THREE.Spherical().setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));
    sphere.theta += 0.1 * step[0];
    sphere.phi = Math.min(Math.max(sphere.phi - 0.08 * step[1], 0.02), controls.maxPolarAngle);
    const turned = new THREE.Vector3().setFromSpherical(sphere);
    camera.position.copy(controls.target).add(new THREE.Vector3(turned.x, -turned.z, turned.y));
  } else if (event.key === "+" || event.key === "=" || event.key === "-") {
    offset.multiplyScalar(event.key === "-" ? 1.15 : 1 / 1.15);
    camera.position.copy(controls.target).add(offset);
  } else {
    return false;
  }
  event.preventDefault();
  controls.update();
  return true;
}
