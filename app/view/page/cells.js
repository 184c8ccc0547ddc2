// The cells in false colours, and cut open. The server draws them, and says what the colours mean.

const byId = (id) => document.getElementById(id);
const sides = { x: 0, y: 1, z: 2 };
const kPatience = 3000;  // milliseconds in which frames may show what was wished for before
const painters = ["painter", "compare"];
const isNumber = (mark) => Number.isFinite(Number(mark.name));
const rgb = (mark) => `rgb(${mark.rgb.join(", ")})`;

function swatch(mark) {
  const row = document.createElement("li");
  const square = document.createElement("i");
  square.style.background = rgb(mark);
  row.append(square, mark.name);
  return row;
}

export class Cells {
  // say(line) sends a line, if this page may say it.
  constructor(say, may) {
    Object.assign(this, { say, may, grid: null, shown: undefined, asked: -kPatience });
    byId("colours").addEventListener("change", () => this.ask());
    byId("cut-axis").addEventListener("change", () => {
      this.label();  // the slider's range is that of the axis
      if (!byId("cut-at").disabled) byId("cut-at").value = Math.floor(this.side() / 2);
      this.askForCells();
    });
    byId("cut-at").addEventListener("input", () => this.askForCells());
    // The page's own painter draws the exact picture.
    for (const one of painters) byId(one).addEventListener("click", () => { if (this.shown) this.end(); });
  }

  showWorld(world) { this.grid = world.grid; this.label(); }

  side() { return this.grid[sides[byId("cut-axis").value]]; }

  // Only cells can be cut.
  askForCells() {
    if (byId("colours").value === "none" && byId("cut-axis").value !== "none") byId("colours").value = "phase";
    this.ask();
  }
  ask() {
    const colours = byId("colours").value, axis = byId("cut-axis").value;
    if (!this.may("cells")) return this.follow();
    this.label();
    this.asked = performance.now();
    clearTimeout(this.later);
    this.later = setTimeout(() => this.follow(), kPatience);
    if (colours !== "none") for (const one of painters) if (byId(one).classList.contains("on")) byId(one).click();
    this.say(colours === "none" ? "cells none" : axis === "none" ? `cells ${colours}` : `cells ${colours} ${axis} ${byId("cut-at").value}`);
  }

  // No frame may come that says it, if this page draws by itself.
  end() {
    this.say("cells none");
    this.showFrame({});
    this.follow();
  }

  // By keys.
  next(name) {
    const list = byId(name);
    list.selectedIndex = (list.selectedIndex + 1) % list.options.length;
    list.dispatchEvent(new Event("change"));
  }
  move(by) {
    if (byId("cut-axis").value === "none") return;
    byId("cut-at").value = Number(byId("cut-at").value) + by;
    this.askForCells();
  }

  label() {
    const cuts = byId("cut-axis").value !== "none" && this.grid;
    byId("cut-at").disabled = !cuts;
    if (cuts) byId("cut-at").max = this.side();
    byId("cut-place").textContent = cuts ? `${byId("cut-at").value} of ${this.side()}` : "";
  }

  // A frame tells what it shows. A page that looks on, or was refused, sees it here.
  showFrame({ cells }, quiet) {
    if (JSON.stringify(cells) === JSON.stringify(this.shown)) return;
    this.shown = cells;
    byId("legend").hidden = !cells;
    if (cells) this.showLegend(cells.legend);
    if (!quiet && performance.now() - this.asked > kPatience) this.follow();
  }

  // The panel shows what the picture shows, also after a wish that was refused.
  follow() {
    byId("colours").value = this.shown?.colours ?? "none";
    byId("cut-axis").value = this.shown?.cut?.axis ?? "none";
    this.label();
    if (this.shown?.cut) byId("cut-at").value = this.shown.cut.at;
    this.label();
  }

  showLegend(marks) {
    const scale = marks.filter(isNumber), bar = byId("legend-bar");
    bar.hidden = scale.length === 0;
    bar.style.background = `linear-gradient(to right, ${scale.map(rgb).join(", ")})`;
    byId("legend-numbers").replaceChildren(...scale.map((mark) => {
      const one = document.createElement("span");
      one.textContent = mark.name;
      return one;
    }));
    byId("legend-names").replaceChildren(...marks.filter((mark) => !isNumber(mark)).map(swatch));
  }
}
