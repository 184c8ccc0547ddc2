// The rays of a camera in integers (docs/picture/definition.md, sections 2 to 4 and 10), as the shader wants them.

const UNIT = 1n << 30n;
const rounded = (a, n) => (a + (1n << (n - 1n))) >> n;
const times = (a, b) => rounded(a * b, 30n);
const divided = (a, b) => (a >= 0n ? a / b : -((b - 1n - a) / b));  // rounded down, b > 0
const each = (f, ...vectors) => [0, 1, 2].map((i) => f(...vectors.map((v) => v[i])));

function fixed(value, bits) {
  const exact = value * 2 ** bits, below = Math.floor(exact);
  return BigInt(below) + (exact - below >= 0.5 ? 1n : 0n);
}

function sineCosine(angle) {
  const quarter = divided(angle, 5898240n);
  const x = rounded((angle - 5898240n * quarter) * 1228166276394n, 32n);
  let t = UNIT, s = 0n, c = UNIT;
  for (let n = 1n; n <= 17n; ++n) {
    t = ((t * x) >> 30n) / n;
    const signed = n % 4n < 2n ? t : -t;
    if (n % 2n === 0n) c += signed; else s += signed;
  }
  return [[s, c], [c, -s], [-s, -c], [-c, s]][Number(((quarter % 4n) + 4n) % 4n)];
}

// The depth of the grid's nearest corner, a little less.
function nearDepth(eye, forward, cells) {
  let near = 1n << 40n;
  for (let corner = 0; corner < 8; ++corner) {
    const from = cells.map((n, i) => ((corner >> i) & 1 ? n * 1048576n + 524288n : -524288n) - eye[i]);
    const depth = from.reduce((sum, v, i) => sum + (v >> 16n) * forward[i], 0n) >> 30n;
    if (depth < near) near = depth;
  }
  return near - 3n;
}

// What the shader needs for a picture of `width` x `height` pixels: pairs of 32 bits for each axis.
export function raysOf(camera, width, height, cellsOfGrid) {
  const cells = cellsOfGrid.map(BigInt), target = camera.target.map((v) => fixed(v, 20));
  const distance = fixed(camera.distance, 12), h = BigInt(height) * 32n, w = BigInt(width) * 32n;
  const [sa, ca] = sineCosine(fixed(camera.azimuth, 16));
  const [se, ce] = sineCosine(fixed(Math.min(89, Math.max(-89, camera.elevation)), 16));
  const [sf, cf] = sineCosine(fixed(camera.field_of_view, 15));
  const back = [times(sa, ce), se, times(ca, ce)], forward = back.map((v) => -v);
  const right = [ca, 0n, -sa], up = [-times(sa, se), ce, -times(ca, se)];
  const tangent = (UNIT * sf) / cf;
  let wide = right.map((v) => (v * tangent) >> 30n), high = up.map((v) => (v * tangent) >> 30n);
  let eye = each((t, b) => t + ((b * distance) >> 22n), target, back);
  let near = nearDepth(eye, forward, cells);
  if (camera.parallel && near < 1n) eye = each((e, f) => e + ((f * (near - 1n)) >> 14n), eye, forward);
  const least = camera.parallel ? 1n : 0n;
  if (near < least) near = least;
  const onPlane = (v) => (camera.parallel ? divided(v * distance, 4096n * h) : divided(v * near, 16n * h));
  const nearWide = wide.map(onPlane), nearHigh = high.map(onPlane);
  const pixel = tangent * (camera.parallel ? distance / 256n : near), limit = (BigInt(height) * 15n) << 25n;
  const halvings = pixel >= 2n * limit ? 0 : pixel >= limit ? 1 : 2;
  if (camera.parallel) { wide = [0n, 0n, 0n]; high = [0n, 0n, 0n]; }

  const pairs = (vector) => Int32Array.from(vector.flatMap((v) =>
    [Number(BigInt.asIntN(32, v >> 32n)), Number(BigInt.asIntN(32, v))]));
  return {
    spacing: 2 + halvings,
    bias: 1024 << halvings,
    corner: pairs(each((f, x, y) => f * h - x * w + y * h, forward, wide, high)),
    to_right: pairs(wide),
    to_below: pairs(high.map((v) => -v)),
    near_corner: pairs(each((x, y) => y * h - x * w, nearWide, nearHigh)),
    near_right: pairs(nearWide),
    near_below: pairs(nearHigh.map((v) => -v)),
    begin: pairs(each((e, f) => e + ((f * near) >> 14n), eye, forward)),
  };
}
