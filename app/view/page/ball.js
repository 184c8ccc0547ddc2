// The ball pours or carves where the pointer is, while it is pressed. A ring shows its size at the place that the
// server says to be under the pointer.
import { cellsPerPixel, project } from "/camera.js";

const byId = (id) => document.getElementById(id);
const kPatience = 120;  // milliseconds from one ball to the next under a pointer that rests

export class Ball {
  // say(line) and change(key, ...numbers) send; camera() is that of the picture.
  constructor(canvas, handles, camera, say, change) {
    Object.assign(this, { canvas, camera, say, change });
    this.tool = null;    // "pour" or "carve"
    this.pointer = null; // where it is, in the window
    this.held = false;   // it is pressed
    this.pressed = false; // and nothing has been done for it yet: a short click counts, too
    this.asked = false;  // an answer of the server is awaited
    this.place = null;   // what lies under the pointer, in cells
    this.ring = document.createElementNS("http://www.w3.org/2000/svg", "circle");
    this.ring.setAttribute("class", "ball");
    handles.append(this.ring);
    for (const tool of ["pour", "carve"]) byId(tool).addEventListener("click", () => this.choose(tool));
    for (const one of ["ball-radius", "ball-temperature"]) byId(one).addEventListener("input", () => this.draw());
    const listen = (name, what) => canvas.addEventListener(name, what, { capture: true });
    listen("pointerdown", (event) => this.press(event));
    listen("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) listen(name, () => { this.held = false; });
    listen("pointerleave", () => { if (!this.held) { this.pointer = null; this.place = null; this.draw(); } });
    setInterval(() => { if (this.held) this.ask(); }, kPatience);
  }

  choose(tool) {
    this.tool = this.tool === tool ? null : tool;
    this.held = false;
    for (const name of ["pour", "carve"]) {
      byId(name).classList.toggle("on", this.tool === name);
      byId(name).setAttribute("aria-pressed", this.tool === name);
    }
    this.canvas.classList.toggle("placing", this.tool !== null);
    this.ring.dataset.tool = tool;
    const does = { pour: "Pour", carve: "Carve" }[this.tool];
    byId("notice").textContent = does ? `${does}: press on the picture. Escape ends it.` : "";
    this.ask();
    this.draw();
  }

  end() { if (this.tool) this.choose(this.tool); }

  // The plain pointer is the tool's. With shift, or the right button, it moves the camera as ever.
  press(event) {
    if (!this.tool || event.button !== 0 || event.shiftKey || !event.isPrimary) return;
    event.stopImmediatePropagation();
    this.canvas.setPointerCapture(event.pointerId);
    this.held = this.pressed = true;
    this.move(event);
  }

  move(event) {
    if (!this.tool) return;
    this.pointer = { x: event.clientX, y: event.clientY };
    this.ask();
  }

  ask() {
    if (!this.tool || !this.pointer || this.asked) return;
    const box = this.canvas.getBoundingClientRect();
    const pixel = (at, from, size, pixels) => Math.min(pixels - 1, Math.max(0, Math.floor(((at - from) / size) * pixels)));
    this.say(["pick", pixel(this.pointer.x, box.left, box.width, this.canvas.width),
              pixel(this.pointer.y, box.top, box.height, this.canvas.height)].join(" "));
    this.asked = true;
    setTimeout(() => { this.asked = false; }, 1000);  // the connection may have been lost
  }

  // Takes an answer, if it is one to this tool.
  hear(pick) {
    if (!this.tool || !this.asked) return false;
    this.asked = false;
    this.place = pick.position ?? null;
    const acts = this.held || this.pressed;
    this.pressed = false;
    if (acts && this.place) {
      const numbers = [...this.place.map((v) => Math.round(v * 16) / 16), Number(byId("ball-radius").value)];
      if (this.tool === "pour") numbers.push(Number(byId("ball-temperature").value));
      this.change(this.tool, ...numbers);
    }
    this.draw();
    return true;
  }

  draw() {
    const box = this.canvas.getBoundingClientRect();
    byId("ball-size").textContent = `${byId("ball-radius").value} cells`;
    byId("ball-heat").textContent = byId("ball-temperature").value;
    const at = this.tool && this.place && this.camera() && project(this.camera(), this.place, box.width, box.height);
    this.ring.style.display = at ? "" : "none";
    if (!at) return;
    this.ring.setAttribute("cx", at.x);
    this.ring.setAttribute("cy", at.y);
    this.ring.setAttribute("r", byId("ball-radius").value / cellsPerPixel(this.camera(), at.depth, box.height));
  }
}
