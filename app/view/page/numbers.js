// The numbers of the scene that a run may change have a slider each, where the scene says them. The form below
// them sets any other.
const byId = (id) => document.getElementById(id);
const names = {
  "heat.air.exchange": "oven: exchange with the air", "heat.air.bottom": "oven: air at the bottom",
  "heat.air.top": "oven: air at the top", "heat.gamma": "conduction", "heat.convection": "convection",
  "material.melting_point": "melting point", "material.latent_heat": "latent heat",
  "material.freezing_point": "freezing point", "flow.viscous.kappa": "mobility",
};
// These have few values, and those are whole numbers.
const choices = { "flow.paper.neighbours": [4, 8], "heat.neighbours": [6, 18, 26], "heat.rays_per_face": [1, 4, 16] };
const wholes = ["visibility_every", "in_liquid", "substeps", "substeps_max", "stages_max"];
// These end at 1, and may be 0. The sliders of others go from a hundredth of the first value to a hundred times it.
const parts = ["bottom", "top", "sky", "melting_point", "latent_heat", "freezing_point", "slump", "hang", "factor", "wall_factor"];

export class Numbers {
  constructor(change) { this.change = change; this.first = new Map(); this.held = false;
    byId("said").addEventListener("pointerdown", () => { this.held = true; });
    addEventListener("pointerup", () => { this.held = false; }); }

  showWorld(world) {
    if (this.held) return;
    byId("said").replaceChildren(...Object.entries(world.numbers).map(([key, value]) => this.row(key, value)));
  }

  row(key, value) {
    if (!this.first.has(key)) this.first.set(key, value || 1);
    const row = document.createElement("label"), text = document.createElement("span");
    row.className = "row";
    text.textContent = names[key] ?? key.split(".").slice(-2).join(" ").replaceAll("_", " ");
    row.append(text, ...(choices[key] ? [this.choice(key, value)] : this.slider(key, value)));
    return row;
  }

  choice(key, value) {
    const select = document.createElement("select");
    select.title = key;
    for (const one of choices[key]) select.add(new Option(one, one, false, one === value));
    select.addEventListener("change", () => this.change(key, Number(select.value)));
    return select;
  }

  slider(key, value) {
    const last = key.split(".").at(-1), part = parts.includes(last), whole = wholes.includes(last);
    const shown = document.createElement("output"), input = document.createElement("input");
    shown.textContent = Number(value.toPrecision(4));
    const range = part ? { min: 0, max: 1, step: 0.005 } : { min: -2, max: 2, step: 0.01 };
    Object.assign(input, { type: "range", title: key, ...range });
    input.value = part ? value : value > 0 ? Math.log10(value / this.first.get(key)) : -2;
    input.addEventListener("input", () => {
      let now = part ? Number(input.value) : this.first.get(key) * 10 ** Number(input.value);
      now = whole ? Math.max(1, Math.round(now)) : Number(now.toPrecision(6));
      shown.textContent = Number(now.toPrecision(4));
      this.change(key, now);
    });
    return [shown, input];
  }
}
