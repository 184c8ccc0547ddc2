// A page may draw by itself, at the screen's rate and by its own camera, whatever the server does. It may also show
// where its picture differs from the server's.
import { difference } from "/difference.js";
import { TexturePainter } from "/painter.js";

const byId = (id) => document.getElementById(id);
const REST = 150;  // milliseconds without news until the fine picture is drawn

export class OwnPainter {
  // say(line) sends a line, look() gives the camera and the size, and told(head) shows a message's facts.
  constructor(say, look, told) {
    Object.assign(this, { say, look, told });
    this.canvas = byId("textures");
    this.canvas.own = this;  // for tests, and for whoever looks in with the browser's tools
    this.on = this.compares = false;
    this.updates = 0;
    this.painter = this.head = this.exact = null;
    this.drawn = "";  // what the canvas shows
    this.queue = Promise.resolve();
    byId("painter").addEventListener("click", () => this.toggle());
    byId("compare").addEventListener("click", () => this.toggleDifference());
  }

  // The server is there, and knows nothing of this page. Versions of another one mean nothing.
  meet() {
    if (this.painter) this.painter.textures.version = 0;
    if (this.on || this.compares) this.choose();
  }

  choose() {
    this.canvas.hidden = !this.on;
    byId("difference").hidden = !this.compares;
    byId("painter").classList.toggle("on", this.on);
    byId("compare").classList.toggle("on", this.compares);
    byId("psnr").textContent = "";
    this.say(`exact ${this.on && !this.compares ? 0 : 1}`);
    if (this.on || this.compares) this.ask(this.painter.textures.version);
  }
  toggle() {
    if (!this.on && !this.prepare()) return;
    this.on = !this.on;
    this.choose();
    if (this.on) this.loop();
  }
  toggleDifference() {
    if (!this.compares && !this.prepare()) return;
    this.compares = !this.compares;
    this.choose();
  }
  prepare() {
    try {
      this.painter ??= new TexturePainter(this.canvas);
    } catch (error) {
      byId("notice").textContent = error.message;
    }
    return this.painter !== null;
  }
  ask(version) { this.say(`textures ${version}`); }

  // Messages are taken over one after the other, and the next one is asked for when this one is.
  take(head, bytes) {
    this.queue = this.queue.then(async () => {
      const news = await this.painter.take(bytes);
      this.head = { ...head, version: news.version, bytes: news.bytes };
      ++this.updates;
      this.canvas.dataset.version = news.version;
      this.canvas.dataset.step = head.step;
      this.told(this.head);
      if (this.on || this.compares) this.ask(news.version);
      this.compare();
    }).catch((error) => { byId("notice").textContent = error.message; });
  }

  // A frame of the server is here.
  takeExact(head, canvas) {
    this.exact = { head, canvas };
    this.compare();
  }

  loop() {
    if (!this.on) return;
    requestAnimationFrame((now) => {
      const { camera, width, height } = this.look();
      const wanted = JSON.stringify([camera, width, height, this.head?.version]);
      if (camera && this.painter.ready && this.wanted !== wanted) {
        this.painter.draw(camera, width, height, false);
        Object.assign(this, { wanted, since: now, fine: false });
        this.canvas.dataset.fine = 0;
      } else if (this.wanted === wanted && !this.fine && now - this.since > REST) {
        this.painter.draw(camera, width, height, true);
        this.fine = true;
        this.canvas.dataset.fine = 1;
      }
      this.loop();
    });
  }

  // Both pictures of one state, by one camera, at rest.
  compare() {
    if (!this.compares || !this.exact || !this.head || !this.painter.ready) return;
    const { head, canvas } = this.exact;
    if (!head.exact || head.quality !== "normal" || head.step !== this.head.step) return;
    this.painter.draw(head.camera, canvas.width, canvas.height, true);
    this.wanted = "";
    const exact = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    const found = difference(exact, this.painter.pixels(), byId("difference"), canvas.width, canvas.height);
    this.compared = head.camera;
    byId("psnr").textContent = found.different === 0 ? "Both painters give the same bytes." :
      `${found.different} pixels differ, by ${found.most} at most: PSNR ${found.psnr.toFixed(1)} dB.`;
  }
}
