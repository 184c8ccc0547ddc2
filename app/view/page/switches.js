// Heat sources, vents and drains go on and off, and a heat source becomes one of another kind.
export const kinds = { point: "point", sphere: "sphere", directional: "sun", sky: "sky" };

// A switch says what it does for the eye and for a reader of the screen.
function button(text, title, on, act) {
  const one = document.createElement("button");
  Object.assign(one, { textContent: text, title });
  one.setAttribute("aria-pressed", on);
  one.classList.toggle("on", on);
  one.addEventListener("click", act);
  return one;
}

export const opening = (name, one, i, change) =>
  button(one.open ? "On" : "Off", `${name}.${i}.${one.open ? "off" : "on"}`, one.open,
         () => change(`${name}.${i}.${one.open ? "off" : "on"}`));

export class Sources {
  // The powers of what is off outlive a reload of the page.
  constructor(change) { this.change = change; this.powers = JSON.parse(sessionStorage.getItem("powers") ?? "[]"); }

  take(world) {
    this.grid = world.grid;
    world.heat_sources.forEach(({ keyframes }, i) => {
      if (keyframes.at(-1).power > 0) this.powers[i] = keyframes.at(-1).power;
    });
    this.keep();
  }
  keep() { sessionStorage.setItem("powers", JSON.stringify(this.powers)); }
  removed(i) { this.powers.splice(i, 1); this.keep(); }

  // What is off has no power. On again, it has the one that it had.
  power(source, i) {
    const key = `heat_source.${i}.power`, on = source.keyframes.at(-1).power > 0;
    return button(on ? "On" : "Off", `${key}: press for ${on ? "0" : "what it was"}`, on,
                  () => this.change(key, on ? 0 : this.powers[i] ?? this.usual(source.kind)));
  }
  usual(kind) { return kind === "sky" || kind === "directional" ? 0.01 : 0.004 * Math.max(...this.grid) ** 2; }

  kind(source, i) {
    const select = document.createElement("select");
    select.title = `heat_source.${i}.${Object.values(kinds).join(", .")}: the kind`;
    select.setAttribute("aria-label", `kind of heat source ${i + 1}`);
    for (const [kind, word] of Object.entries(kinds)) select.add(new Option(word, kind, false, kind === source.kind));
    select.addEventListener("change", () => this.become(source, i, select.value));
    return select;
  }

  // The middle of the grid gets about as much heat as before, from the same side.
  become(source, i, kind) {
    const now = source.keyframes.at(-1), middle = this.grid.map((n) => n / 2);
    const near = (one) => one === "point" || one === "sphere";
    const length = (v) => Math.hypot(...v) || 1;
    const away = near(source.kind) ? now.at.map((v, k) => v - middle[k]) : source.kind === "sky" ? [0, 1, 0] : now.direction;
    const distance = near(source.kind) ? Math.max(1, length(away)) : Math.max(...this.grid);
    const at = near(source.kind) ? now.at : middle.map((v, k) => v + (away[k] / length(away)) * distance);
    const factor = near(kind) === near(source.kind) ? 1 : near(kind) ? distance ** 2 : distance ** -2;
    const rounded = (v) => Number(v.toPrecision(6)), place = (near(kind) ? at : away).map(rounded);
    if (now.power === 0) { delete this.powers[i]; this.keep(); }  // that was of another unit
    this.change(`heat_source.${i}.${kinds[kind]}`, ...(kind === "sky" ? [] : place),
                ...(kind === "sphere" ? [Math.max(1, rounded(now.radius || Math.max(...this.grid) / 20))] : []), rounded(now.power * factor));
  }
}
