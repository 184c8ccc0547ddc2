// Small plots of mass and heat by phase over the steps, and whether the ledgers balance.

const byId = (id) => document.getElementById(id);
const kWide = 240, kHigh = 46, kMost = 600;
const phases = ["solid", "liquid"];
const round = (v) => (v >= 100 ? Math.round(v).toLocaleString("en") : v.toPrecision(3));

export class Books {
  constructor() { this.history = []; this.bytes = 0; this.skipped = 0; }

  // A message of the server is so large.
  count(bytes) { this.bytes = bytes; }

  take(books) {
    this.history = this.history.filter((one) => one.step < books.step);
    this.history.push(books);
    if (this.history.length > kMost) this.history = this.history.filter((_, i) => i % 2 === 0);
    for (const [quantity, unit] of [["mass", "full cells"], ["heat", "full cells at 1"]]) this.plot(quantity, unit);
    const wrong = Object.entries(books.drift).filter(([, value]) => value !== "0");
    byId("drift").textContent = wrong.length === 0 ? "All ledgers balance: the drift is 0."
      : `The ledgers drift: ${wrong.map(([name, value]) => `${name} ${value}`).join(", ")}.`;
    byId("drift").classList.toggle("wrong", wrong.length > 0);
    const loose = books.loose_cells;
    byId("loose").textContent = `Step ${books.step}: ` + (loose === 0 ? "nothing is loose."
      : `${loose.toLocaleString("en")} solid cell${loose > 1 ? "s are" : " is"} loose: nothing holds ${loose > 1 ? "them" : "it"}.`);
    byId("loose").classList.toggle("notable", loose > 0);
    byId("memory").textContent = `Earlier states: ${(books.kept_bytes / 1e6).toFixed(1)} MB. ` +
      `Last message: ${(this.bytes / 1e3).toFixed(0)} kB. Frames that this page had no time for: ${this.skipped}.`;
  }

  plot(quantity, unit) {
    const first = this.history[0].step, last = this.history.at(-1), span = Math.max(1, last.step - first);
    const most = Math.max(1e-9, ...this.history.flatMap((one) => phases.map((phase) => one[quantity][phase])));
    const line = (phase) => this.history
      .map((one) => `${(kWide * (one.step - first)) / span},${kHigh - 2 - ((kHigh - 4) * one[quantity][phase]) / most}`);
    byId(`plot-${quantity}`).innerHTML =
      phases.map((phase) => `<polyline class="${phase}" points="${line(phase).join(" ")}"/>`).join("");
    byId(`legend-${quantity}`).innerHTML = `${quantity} in ${unit}: ` +
      phases.map((phase) => `<span class="${phase}">${phase} ${round(last[quantity][phase])}</span>`).join(", ");
  }
}
