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
  // A browser may decline a second file that comes by itself. So the film stays behind a link.
  done(name, file) {
    this.show(false, "The browser keeps ");
    const link = document.createElement("a");
    Object.assign(link, { href: URL.createObjectURL(file), download: name, textContent: name });
    byId("film-text").append(link, ". If it did not, press on the name.");
  }
  show(running, text) {
    this.running = running;
    byId("film").textContent = running ? "Stop the film" : "Make film";
    byId("film-text").textContent = text;
  }
}
