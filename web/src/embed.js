// Live figures for other pages:
//
//     <script type="module" src="page/embed.js"></script>
//     <slideway-live model="klepp-2002" set="F_20=0" vary="mu_1=0..0.8">
//       <img src="static.svg" alt="what the figure shows">
//     </slideway-live>
//
// What stands inside is shown where scripts are off, or the engine cannot be had. The engine is fetched once a figure
// comes into view.

import { element, settled } from "./dom.js";
import { Drawings, showVerdict } from "./drawings.js";
import { withUnit } from "./numbers.js";
import { State } from "./state.js";
import { Strip } from "./strip.js";
import { Engine, Newest, load } from "./workers.js";

const here = (name) => new URL(name, import.meta.url).href;
let engines;

/** The engines and the models to begin with, for all figures of a page. */
async function begin() {
  const module = await load(here("engine.wasm"));
  const [live, slow] = [0, 1].map(() => new Engine(module, here("worker.js")));
  const { answer: library } = await live.ask({ ask: "library" });
  return { newest: new Newest(live), slow, library };
}

class Live extends HTMLElement {
  connectedCallback() {
    const watch = new IntersectionObserver(([entry]) => {
      if (!entry.isIntersecting) return;
      watch.disconnect();
      this.#begin().catch(() => {});
    });
    watch.observe(this);
  }

  async #begin() {
    engines ??= begin();
    const { newest, slow, library } = await engines;
    const state = await State.of(new URLSearchParams({ model: `gallery:${this.getAttribute("model")}` }), library);
    for (const setting of (this.getAttribute("set") ?? "").split(";").filter(Boolean)) {
      const [name, value] = setting.split("=").map((part) => part.trim());
      state.changes.set(`parameter ${name}`, value);
    }
    const [name, range] = this.getAttribute("vary").split("=");
    const parts = { box: element("div", { class: "verdict" }), verdict: element("strong", { role: "status" }), certainty: element("span", {}), reasons: element("ul") };
    parts.box.append(parts.verdict, " ", parts.certainty, parts.reasons);
    const pictures = element("div", { class: "drawings", role: "list", "aria-label": "The mechanism and its solutions" });
    const figure = element("div", {}, parts.box, pictures);
    const drawings = new Drawings(pictures);
    let quantity;
    const look = () => newest.want(() => ({ question: { ask: "look", ...state.asked(), margins: false } }), take, () => {});
    const strip = new Strip(figure, (value) => {
      state.changes.set(`${quantity.kind} ${name}`, withUnit(value, quantity.unit));
      look();
    });
    const link = element("a", { href: here("./") }, "Open in the page");
    const linked = settled(async () => { link.href = `${here("./")}#${await state.address()}`; }, 200);
    figure.append(element("p", {}, link));
    const take = ({ answer }) => {
      if (!answer) return;
      quantity = answer.quantities.find((one) => one.name === name && one.kind !== "rate");
      state.strip ??= this.#ends(quantity, range);
      showVerdict(parts, answer);
      drawings.show(answer.drawings);
      strip.prepare(state.strip, quantity);
      linked();
      if (this.firstElementChild !== figure) this.#show(figure, strip, slow, state, name, range, quantity);
    };
    look();
  }

  #ends(quantity, range) {
    const [from, to] = range.split("..").map((end) => Number.parseFloat(end));
    return { kind: quantity.kind, name: quantity.name, from, to };
  }

  /** Takes the place of the static picture. */
  async #show(figure, strip, slow, state, name, range, quantity) {
    this.replaceChildren(figure);
    const reply = await slow.ask({ ask: "limits", ...state.asked(quantity), vary: `${name}=${range}` });
    if (reply.answer) strip.show(JSON.parse(reply.answer.json));
  }
}

customElements.define("slideway-live", Live);
