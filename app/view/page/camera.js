// The camera as voxmelt has it: angles in degrees, lengths in cells. Places become pixels by perspective.

const radians = (degrees) => (degrees * Math.PI) / 180;
export const add = (a, b, factor = 1) => a.map((v, i) => v + factor * b[i]);
const dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);

// The axes of the picture: to the right, up, and from the target to the eye.
export function axes(camera) {
  const a = radians(camera.azimuth), e = radians(camera.elevation);
  return {
    right: [Math.cos(a), 0, -Math.sin(a)],
    up: [-Math.sin(a) * Math.sin(e), Math.cos(e), -Math.cos(a) * Math.sin(e)],
    back: [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)],
  };
}

// The cells that a pixel is high, at this distance from the eye.
export function cellsPerPixel(camera, distance, height) {
  return (2 * distance * Math.tan(radians(camera.field_of_view) / 2)) / height;
}

// The pixel of a place, and its distance before the eye; nothing if it lies behind.
export function project(camera, place, width, height) {
  const { right, up, back } = axes(camera);
  const from = add(place, camera.target, -1);
  const depth = camera.distance - dot(from, back);
  if (depth <= 0.1) return null;
  const scale = 1 / cellsPerPixel(camera, depth, height);
  return { x: width / 2 + dot(from, right) * scale, y: height / 2 - dot(from, up) * scale, depth };
}

const clamp = (v, low, high) => Math.min(high, Math.max(low, v));

export function turned(camera, dx, dy) {
  let azimuth = camera.azimuth - dx * 0.4;
  while (azimuth > 180) azimuth -= 360;
  while (azimuth < -180) azimuth += 360;
  return { ...camera, azimuth, elevation: clamp(camera.elevation + dy * 0.4, -89, 89) };
}
export function moved(camera, dx, dy, height) {
  const { right, up } = axes(camera);
  const cells = cellsPerPixel(camera, camera.distance, height);
  const target = add(add(camera.target, right, -dx * cells), up, dy * cells);
  return { ...camera, target: target.map((v) => clamp(v, -60000, 60000)) };
}
export function nearer(camera, factor) {
  return { ...camera, distance: clamp(camera.distance * factor, 1, 100000) };
}
