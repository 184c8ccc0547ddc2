// The panel: what can be changed, and what is seen of it. Every change is a key of the scene file.
import { kinds, opening, Sources } from "/switches.js";

const byId = (id) => document.getElementById(id);
const round = (v, digits = 3) => Number(v.toPrecision(digits));

// A slider whose steps are even in the logarithm, from a hundredth of `middle` to a hundred times it.
function logarithmicRow(name, key, value, middle, change) {
  const row = document.createElement("label");
  row.className = "row";
  const text = document.createElement("span");
  text.textContent = name;
  const shown = document.createElement("output");
  shown.textContent = round(value);
  const input = document.createElement("input");
  Object.assign(input, { type: "range", min: -2, max: 2, step: 0.01, title: key });
  input.dataset.key = key;
  input.value = value > 0 ? Math.log10(value / middle) : -2;
  input.addEventListener("input", () => {
    const now = round(middle * 10 ** Number(input.value), 6);
    shown.textContent = round(now);
    change(key, now);
  });
  row.append(text, shown, input);
  return row;
}

function removal(key, change, done) {
  const button = document.createElement("button");
  button.textContent = "Remove";
  button.title = key;
  button.addEventListener("click", () => { done?.(); change(key); });
  return button;
}

export class Panel {
  // say(line) sends a line; change(key, ...numbers) sends a change.
  constructor(say, change) {
    this.change = change;
    this.sources = new Sources(change);
    this.middles = new Map();  // of sliders, by key: the value that they first had
    this.busy = false;  // a slider is being dragged, and must not be replaced under the pointer
    byId("panel").addEventListener("pointerdown", () => { this.busy = true; });
    addEventListener("pointerup", () => { this.busy = false; });
    byId("play").addEventListener("click", () => say(`play ${this.playing ? 0 : 1}`));
    byId("single").addEventListener("click", () => say("step 1"));
    byId("restart").addEventListener("click", () => say("restart"));
    byId("home").addEventListener("click", () => say("home"));
    byId("best").addEventListener("click", () => say("best"));
    byId("speed").addEventListener("input", (event) => {
      byId("speed-shown").textContent = event.target.value;
      say(`speed ${event.target.value}`);
    });
    byId("help").addEventListener("click", () => this.toggleKeys());
    byId("add-source").addEventListener("click", () => {
      const [x, y, z] = this.world.grid;
      change("heat_source.add", x / 2, y * 1.1, z * 1.1, round(0.004 * Math.max(x, y, z) ** 2));
    });
    byId("add-sun").addEventListener("click", () => change("heat_source.add_sun", 1, 2, 1, 0.01));
    byId("add-sky").addEventListener("click", () => change("heat_source.add_sky", 0.01));
    byId("numbers").addEventListener("submit", (event) => {
      event.preventDefault();
      change(byId("key").value, Number(byId("value").value));
    });
  }

  toggleKeys() { byId("keys").hidden = !byId("keys").hidden; byId("keys").scrollIntoView(); }

  showWorld(world) {
    this.world = world;
    byId("title").textContent = world.title || world.scene;
    byId("facts").textContent =
      `${world.scene}, ${world.grid.join(" × ")} cells, ${world.implementation}, ${world.threads} threads`;
    document.title = `${world.scene} · voxmelt`;
    if (byId("key").options.length === 0)
      for (const key of world.keys) byId("key").add(new Option(key, key));
    this.sources.take(world);
    if (this.busy) return;
    this.showList("sources", world.heat_sources, "heat_source", (source, i) => {
      const { at, power } = source.keyframes.at(-1), near = source.kind === "point" || source.kind === "sphere";
      const place = near ? ` at ${at.map((v) => round(v)).join(", ")}` : "";
      return [[`${i + 1}. ${kinds[source.kind]}${place}: power`, "power", power]];
    }, (source, i) => [this.sources.kind(source, i), this.sources.power(source, i)], (i) => this.sources.removed(i));
    this.showList("vents", world.vents, "vent", (vent, i) =>
      [[`${i + 1}. rate`, "rate", vent.rate], ["temperature", "temperature", vent.temperature],
       ["radius", "radius", vent.radius]], (vent, i) => [opening("vent", vent, i, this.change)]);
    this.showList("drains", world.drains, "drain", (drain, i) =>
      [[`${i + 1}. rate`, "rate", drain.rate], ["radius", "radius", drain.radius]],
      (drain, i) => [opening("drain", drain, i, this.change)]);
  }

  showList(place, list, name, rowsOf, switchesOf, removed) {
    const rows = [];
    list.forEach((one, i) => {
      for (const [label, part, value] of rowsOf(one, i)) {
        const key = `${name}.${i}.${part}`;
        if (!this.middles.has(key)) this.middles.set(key, value > 0 ? value : 1);
        rows.push(logarithmicRow(label, key, value, this.middles.get(key), this.change));
      }
      const buttons = document.createElement("div");
      buttons.className = "switches";
      buttons.append(...switchesOf(one, i), removal(`${name}.${i}.remove`, this.change, () => removed?.(i)));
      rows.push(buttons);
    });
    byId(place).replaceChildren(...rows);
  }

  showFrame(head, framesPerSecond) {
    this.playing = head.playing;
    byId("play").textContent = head.playing ? "Pause" : "Play";
    byId("play").classList.toggle("on", head.playing);
    if (document.activeElement !== byId("speed")) byId("speed").value = byId("speed-shown").textContent = head.speed;
    const { step, draw, encode } = head.ms;
    byId("speeds").textContent =
      `Step ${head.step}. ${framesPerSecond.toFixed(0)} frames a second. ` +
      `${step.toFixed(1)} ms for ${head.speed} steps, ${draw.toFixed(1)} ms to draw (${head.quality}), ` +
      `${encode.toFixed(1)} ms to encode.` + (head.digest ? ` Digest ${head.digest}.` : "");
  }

  showPick(pick) {
    if (!pick.cell) { byId("probe").textContent = "Nothing is there."; return; }
    const fields = Object.entries(pick.fields).map(([name, value]) => `${name} ${value}`).join(", ");
    byId("probe").textContent = `${pick.shown}, cell ${pick.cell.join(", ")}: ${fields}`;
  }
}
