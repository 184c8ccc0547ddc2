// The slider goes back to an earlier step. It shows the present one while nobody holds it.

const byId = (id) => document.getElementById(id);

export class Past {
  constructor(say) {
    this.say = say;
    const slider = byId("past");
    slider.addEventListener("input", () => { byId("past-step").textContent = `step ${slider.value}`; });
    slider.addEventListener("change", () => { slider.blur(); this.goBack(Number(slider.value)); });
  }

  showFrame(head) {
    this.head = head;
    const slider = byId("past");
    if (document.activeElement === slider) return;
    Object.assign(slider, { min: head.first, max: head.step, value: head.step, disabled: head.step === head.first });
    byId("past-step").textContent = `step ${head.step}`;
  }

  goBack(step) {
    if (this.head && step >= this.head.first && step < this.head.step) this.say(`back ${step}`);
  }
  oneBack() { if (this.head) this.goBack(this.head.step - 1); }
}
