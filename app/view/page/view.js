// The page talks to the server in lines of text, and shows the frames that come back.
import { add, axes, cellsPerPixel, moved, nearer, project, turned } from "/camera.js";
import { Ball } from "/ball.js";
import { Books } from "/books.js";
import { Cells } from "/cells.js";
import { Film } from "/film.js";
import { Hands } from "/hands.js";
import { Numbers } from "/numbers.js";
import { OwnPainter } from "/own_painter.js";
import { Panel } from "/panel.js";
import { Past } from "/past.js";

const byId = (id) => document.getElementById(id);
const canvas = byId("picture"), handles = byId("handles");
const state = { camera: null, head: null, world: null, own: null, placing: null, times: [] };
let socket = null, wait = 500;

const say = (line) => { if (socket?.readyState === WebSocket.OPEN && hands.may(line)) socket.send(line); };
const hands = new Hands(say, () => size());
const change = (key, ...numbers) => say(["change", key, ...numbers].join(" "));
const panel = new Panel(say, change);
const past = new Past(say);
const film = new Film(say);
const books = new Books();
const cells = new Cells(say, (line) => hands.may(line));
const numbers = new Numbers(change);
const own = new OwnPainter(say, () => ({ camera: camera(), ...state.size }), (head) => seen(head));

function connect() {
  socket = new WebSocket(`ws://${location.host}/socket${location.search}`);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => { wait = 500; byId("notice").textContent = ""; size(); own.meet(); };
  socket.onmessage = (event) => (typeof event.data === "string" ? hear(JSON.parse(event.data)) : show(event.data));
  socket.onclose = () => {
    byId("notice").textContent = "The server is not there. This page asks for it again until it is.";
    setTimeout(connect, wait);
    wait = Math.min(5000, 2 * wait);
  };
}

function hear(message) {
  if (message.type === "world") { state.world = message; panel.showWorld(message); numbers.showWorld(message); cells.showWorld(message); drawHandles(); }
  if (message.type === "pick" && !ball.hear(message)) panel.showPick(message);
  if (message.type === "film") film.hear(message);
  if (message.type === "hands") hands.take(message);
  if (message.type === "dropped") books.skipped = message.frames;
  if (message.type === "books") books.take(message);
  if (message.type === "refused") {
    if (message.line.startsWith("cells")) cells.follow();
    byId("notice").textContent = message.why;
    setTimeout(() => { if (byId("notice").textContent === message.why) byId("notice").textContent = ""; }, 6000);
  }
}

function download(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

async function show(bytes) {
  books.count(bytes.byteLength);
  const length = new DataView(bytes).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
  if (head.type === "file") {
    const file = new Blob([new Uint8Array(bytes, 4 + length)]);
    if (/\.(mp4|webp)$/.test(head.name)) film.done(head.name, file);
    return download(head.name, file);
  }
  if (head.type === "textures") return own.take(head, new Uint8Array(bytes, 4 + length));
  const type = head.exact ? "image/png" : "image/jpeg";
  const picture = await createImageBitmap(new Blob([new Uint8Array(bytes, 4 + length)], { type }));
  if (canvas.width !== picture.width || canvas.height !== picture.height)
    Object.assign(canvas, { width: picture.width, height: picture.height });
  canvas.getContext("2d").drawImage(picture, 0, 0);
  picture.close();
  canvas.dataset.quality = head.quality;
  cells.showFrame(head, panel.busy);
  seen(head);
  if (!head.cells) own.takeExact(head, canvas);
}

// The facts of a frame, or of textures.
function seen(head) {
  const now = performance.now();
  state.times = [...state.times.filter((t) => now - t < 2000), now];
  state.head = head;
  state.camera = head.camera;
  if (!pointers.size && (!own.on || shows(head.camera, state.own))) state.own = null;
  canvas.dataset.step = head.step;
  canvas.dataset.digest = head.digest ?? "";
  panel.showFrame(head, state.times.length / 2);
  past.showFrame(head);
  drawHandles();
  ball.draw();
}

// The camera that the hand has set, until a frame shows it.
const camera = () => state.own ?? state.camera;
const ball = new Ball(canvas, handles, camera, say, change);
// The server rounds a distance to 4096ths.
const shows = (a, b) => !b || (a.azimuth === b.azimuth && a.elevation === b.elevation &&
  Math.abs(a.distance - b.distance) < 0.001 && a.target.every((v, i) => v === b.target[i]));
let cameraAsked = false;
function look(next) {
  state.own = next;
  if (cameraAsked) return;
  cameraAsked = true;
  requestAnimationFrame(() => {
    cameraAsked = false;
    const c = state.own;
    drawHandles();
    if (c) say(["camera", c.azimuth, c.elevation, c.distance, ...c.target].join(" "));
  });
}

function size() {
  const box = byId("stage").getBoundingClientRect(), most = 1280;
  const scale = Math.min(1, most / Math.max(box.width, box.height, 1));
  const side = (v) => Math.max(64, Math.round(v * scale));
  state.size = { width: side(box.width), height: side(box.height) };
  say(`size ${state.size.width} ${state.size.height}`);
}
new ResizeObserver(() => size()).observe(byId("stage"));

// --- The hand on the picture ---

const pointers = new Map();
let grip = null;  // what the hand holds: "turn", "move", or a source

const point = (event) => {
  const box = canvas.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top, width: box.width, height: box.height };
};

canvas.addEventListener("contextmenu", (event) => event.preventDefault());
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, point(event));
  grip = { kind: event.shiftKey || event.button === 2 || pointers.size > 1 ? "move" : "turn", way: 0 };
  canvas.classList.add("turning");
});
canvas.addEventListener("pointermove", (event) => {
  if (!pointers.has(event.pointerId) || !camera()) return;
  const before = pointers.get(event.pointerId), now = point(event);
  const dx = now.x - before.x, dy = now.y - before.y;
  grip.way += Math.abs(dx) + Math.abs(dy);
  if (pointers.size === 2) {
    const other = [...pointers.entries()].find(([id]) => id !== event.pointerId)[1];
    const was = Math.hypot(before.x - other.x, before.y - other.y), is = Math.hypot(now.x - other.x, now.y - other.y);
    if (is > 0) look(moved(nearer(camera(), was / is), dx / 2, dy / 2, now.height));
  } else if (grip.kind === "move") {
    look(moved(camera(), dx, dy, now.height));
  } else {
    look(turned(camera(), dx, dy));
  }
  pointers.set(event.pointerId, now);
});
const release = (event) => {
  const at = pointers.get(event.pointerId);
  pointers.delete(event.pointerId);
  if (pointers.size === 0) canvas.classList.remove("turning");
  if (!at || !grip || grip.way > 4 || event.type === "pointercancel") return;
  const x = Math.min(canvas.width - 1, Math.floor((at.x / at.width) * canvas.width));
  const y = Math.min(canvas.height - 1, Math.floor((at.y / at.height) * canvas.height));
  say(`pick ${Math.max(0, x)} ${Math.max(0, y)}`);
};
canvas.addEventListener("pointerup", release);
canvas.addEventListener("pointercancel", release);
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  if (camera()) look(nearer(camera(), Math.exp(event.deltaY * 0.001)));
}, { passive: false });

// --- Handles of heat sources: a ring, and a plumb line to the floor as a cue of depth ---

function svg(name, attributes) {
  const one = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
  return one;
}

const shown = new Map();  // the shapes of a source, by its number

function drawHandles() {
  if (!state.world || !state.camera || grip?.source !== undefined) return;
  const box = canvas.getBoundingClientRect();
  const sources = state.world.heat_sources;
  for (const i of [...shown.keys()])
    if (!["point", "sphere"].includes(sources[i]?.kind)) {
      Object.values(shown.get(i)).forEach((shape) => shape.remove());
      shown.delete(i);
    }
  sources.forEach((source, i) => {
    if (source.kind !== "point" && source.kind !== "sphere") return;
    if (!shown.has(i)) shown.set(i, newHandle(i));
    placeHandle(shown.get(i), source.keyframes.at(-1).at, box);
  });
}

function newHandle(i) {
  const shapes = {
    plumb: svg("path", { class: "plumb" }),
    foot: svg("ellipse", { class: "foot", rx: 7, ry: 3 }),
    ring: svg("circle", { class: "ring", r: 10, "data-source": i }),
  };
  shapes.ring.append(svg("title", {}));
  shapes.ring.firstChild.textContent = `heat_source.${i}.at: drag; with shift up and down`;
  shapes.ring.addEventListener("pointerdown", (event) => holdSource(event, i, shapes));
  handles.append(...Object.values(shapes));
  return shapes;
}

// A source that is out of the picture has its ring at the edge.
function placeHandle({ ring, plumb, foot }, at, box) {
  const top = project(camera(), at, box.width, box.height);
  const below = project(camera(), [at[0], 0, at[2]], box.width, box.height);
  ring.style.display = top ? "" : "none";
  plumb.style.display = foot.style.display = top && below ? "" : "none";
  if (!top) return;
  ring.setAttribute("cx", Math.min(box.width - 14, Math.max(14, top.x)));
  ring.setAttribute("cy", Math.min(box.height - 14, Math.max(14, top.y)));
  if (!below) return;
  plumb.setAttribute("d", `M${top.x} ${top.y}L${below.x} ${below.y}`);
  foot.setAttribute("cx", below.x);
  foot.setAttribute("cy", below.y);
}

// Without shift the source moves at its height, along the floor; with shift it moves up and down.
function holdSource(event, i, shapes) {
  const ring = shapes.ring;
  event.preventDefault();
  ring.setPointerCapture(event.pointerId);
  grip = { source: i, at: state.world.heat_sources[i].keyframes.at(-1).at, last: point(event) };
  const move = (moveEvent) => {
    const now = point(moveEvent), c = camera();
    const here = project(c, grip.at, now.width, now.height);
    if (!here) return;
    const cells = cellsPerPixel(c, here.depth, now.height);
    const dx = (now.x - grip.last.x) * cells, dy = (now.y - grip.last.y) * cells;
    const { right, up, back } = axes(c);
    grip.last = now;
    if (moveEvent.shiftKey) {
      grip.at = [grip.at[0], grip.at[1] - dy / Math.max(0.2, up[1]), grip.at[2]];
    } else {
      const ahead = Math.max(0.2, Math.abs(back[1]));  // a step into the picture is foreshortened
      const flat = [Math.sin((c.azimuth * Math.PI) / 180), 0, Math.cos((c.azimuth * Math.PI) / 180)];
      grip.at = add(add(grip.at, right, dx), flat, dy / ahead);
    }
    grip.at = grip.at.map((v) => Math.round(v * 16) / 16);
    placeHandle(shapes, grip.at, now);
    change(`heat_source.${i}.at`, ...grip.at);
  };
  const end = () => {
    ring.removeEventListener("pointermove", move);
    grip = null;
    drawHandles();
  };
  ring.addEventListener("pointermove", move);
  ring.addEventListener("pointerup", end, { once: true });
  ring.addEventListener("pointercancel", end, { once: true });
}

// --- What can be kept ---

byId("save-picture").addEventListener("click", () =>
  (own.on ? own.canvas : canvas).toBlob((blob) => download(`${state.world.scene}-${String(state.head.step).padStart(6, "0")}.png`, blob)));
byId("save-checkpoint").addEventListener("click", () => say("save checkpoint"));
byId("save-scene").addEventListener("click", () => say("save scene"));
byId("save-journal").addEventListener("click", () => say("save journal"));

// --- A vent or a drain where a click says ---

function place(what) {
  state.placing = state.placing === what ? null : what;
  canvas.classList.toggle("placing", state.placing !== null);
  for (const one of ["vent", "drain"]) byId(`add-${one}`).classList.toggle("on", state.placing === one);
}
for (const one of ["vent", "drain"]) byId(`add-${one}`).addEventListener("click", () => place(one));
const showPick = panel.showPick.bind(panel);
panel.showPick = (pick) => {
  showPick(pick);
  if (!state.placing || !pick.position) return;
  const [x, y, z] = pick.position;
  if (state.placing === "vent") change("vent.add", x, y + 1, z, 3, 0.2, 0.9);
  else change("drain.add", x, y + 1, z, 3, 0.2);
  place(null);
};

// --- Keys ---

addEventListener("keydown", (event) => {
  if (event.target.matches("input, select, textarea") || event.ctrlKey || event.metaKey || event.altKey) return;
  const turn = { ArrowLeft: [-12, 0], ArrowRight: [12, 0], ArrowUp: [0, 12], ArrowDown: [0, -12] }[event.key];
  if (turn && camera()) look(turned(camera(), ...turn));
  else if ((event.key === "+" || event.key === "=") && camera()) look(nearer(camera(), 0.9));
  else if (event.key === "-" && camera()) look(nearer(camera(), 1 / 0.9));
  else if (event.key === " ") { if (event.target.matches("button")) event.target.blur(); byId("play").click(); }
  else if (event.key === ".") byId("single").click();
  else if (event.key === "r") byId("restart").click();
  else if (event.key === "h") { state.own = null; byId("home").click(); }
  else if (event.key === "t") byId("painter").click();
  else if (event.key === "d") byId("compare").click();
  else if (event.key === "f") cells.next("colours");
  else if (event.key === "x") cells.next("cut-axis");
  else if (event.key === "[" || event.key === "]") cells.move(event.key === "]" ? 1 : -1);
  else if (event.key === "b") byId("best").click();
  else if (event.key === ",") past.oneBack();
  else if (event.key === "p") byId("pour").click();
  else if (event.key === "c") byId("carve").click();
  else if (event.key === "?") panel.toggleKeys();
  else if (event.key === "Escape") { byId("keys").hidden = true; ball.end(); place(null); }
  else return;
  event.preventDefault();
});

connect();
