// One page has the hands. The others look on, and may ask for them.

const byId = (id) => document.getElementById(id);
const free = ["pick", "save", "exact", "textures", "hands"];

export class Hands {
  constructor(say, gained) {
    Object.assign(this, { gained, yours: true, asked: false });
    byId("hands-button").addEventListener("click", () => {
      say(this.yours ? "give" : "hands");
      if (!this.yours) byId("hands-text").textContent = "The other page is asked. Ask again after 5 seconds, and they are yours.";
    });
  }

  may(line) { return this.yours || free.includes(line.split(" ")[0]); }

  take(message) {
    const gains = message.yours && !this.yours;
    this.yours = message.yours;
    const shown = !message.yours || message.asked;
    byId("hands").hidden = !shown;
    byId("hands-text").textContent = message.yours ? "Another page asks for the hands." : "Another page has the hands. You look on.";
    byId("hands-button").textContent = message.yours ? "Give them" : "Ask for them";
    if (gains) this.gained();
  }
}
