// The film of all that was done so far: the server makes it beside the run, and says how far it is.
const byId = (id) => document.getElementById(id);

export class Film {
  constructor(say) {
    this.running = false;
    byId("film").addEventListener("click", () => { say(`film ${this.running ? 0 : 1}`); });
  }

  hear({ frames, planned, over, problem }) {
    this.show(!over, over ? problem || "The film was stopped." : `Frame ${frames} of ${planned} is drawn.`);
  }
  done(name) { this.show(false, `${name} is saved.`); }
  show(running, text) {
    this.running = running;
    byId("film").textContent = running ? "Stop the film" : "Make film";
    byId("film-text").textContent = text;
  }
}
