// Live figures for other pages:
//
//     <script type="module" src="page/embed.js"></script>
//     <slideway-live model="klepp-2002" set="F_20=0" vary="mu_1=0..0.8">
//       <img src="static.svg" alt="what the figure shows">
//     </slideway-live>
//
// What stands inside is shown where scripts are off, and until the engine is there, which is fetched once a figure comes
// near.

import { element, settled } from "./dom.js";
import { Drawings, showVerdict } from "./drawings.js";
import { withUnit } from "./numbers.js";
import { State } from "./state.js";
import { Strip } from "./strip.js";
import { Engine, Newest, Turns, load } from "./workers.js";

const here = (name) => new URL(name, import.meta.url).href;
let asked;

/** What all figures of a page share: an engine for questions that take longer, and the models to begin with. */
async function begin() {
  const module = load(here("engine.wasm"));
  const slow = new Turns(new Engine(module, here("worker.js")));
  const library = await (await fetch(here("library.json"))).json();
  return { module, slow, library };
}

/** Whether the page around an element is dark. */
function isDark(place) {
  for (let at = place; at; at = at.parentElement) {
    const [red, green, blue, alpha = 1] = getComputedStyle(at)
      .backgroundColor.match(/[\d.]+/g)
      .map(Number);
    if (alpha > 0) return 0.299 * red + 0.587 * green + 0.114 * blue < 128;
  }
  return false;
}

class Live extends HTMLElement {
  #state;
  #quantity;
  #drawings;
  #strip;
  #parts = {
    box: element("div", { id: "verdict-box" }),
    verdict: element("span", { role: "status" }),
    certainty: element("p"),
    reasons: element("ul"),
  };
  #link = element("a", { href: here("./") }, "Open in the page");

  connectedCallback() {
    const watch = new IntersectionObserver(
      ([entry]) => {
        if (!entry.isIntersecting) return;
        watch.disconnect();
        this.#begin().catch((error) => console.warn(error));
      },
      { rootMargin: "200px" },
    );
    watch.observe(this);
  }

  async #begin() {
    asked ??= begin();
    const { module, slow, library } = await asked;
    const newest = new Newest(new Engine(module, here("worker.js")));
    this.#state = await State.of(new URLSearchParams({ model: `gallery:${this.getAttribute("model")}` }), library);
    for (const setting of (this.getAttribute("set") ?? "").split(";").filter(Boolean)) {
      const [name, value] = setting.split("=").map((part) => part.trim());
      this.#state.changes.set(`parameter ${name}`, value);
    }
    const root = this.attachShadow({ mode: "open" });
    const { box, verdict, certainty, reasons } = this.#parts;
    box.append(element("h2", {}, verdict), certainty, reasons);
    const pictures = element("div", { id: "drawings", role: "list", "aria-label": "The mechanism and its solutions" });
    const figure = element("div", { class: "live", hidden: true }, box, pictures);
    root.append(
      element("link", { rel: "stylesheet", href: here("drawing.css") }),
      element("link", { rel: "stylesheet", href: here("style.css") }),
      element("slot"),
      figure,
    );
    this.#drawings = new Drawings(pictures);
    const look = () =>
      newest.want(
        () => ({ question: { ask: "look", ...this.#state.asked(), margins: false } }),
        ({ answer }) => answer && this.#show(answer, figure, slow),
        () => {},
      );
    this.#strip = new Strip(figure, (value) => {
      this.#state.changes.set(`${this.#quantity.kind} ${this.#quantity.name}`, withUnit(value, this.#quantity.unit));
      look();
    });
    figure.append(element("p", {}, this.#link));
    look();
  }

  #show(answer, figure, slow) {
    const [name, range] = this.getAttribute("vary").split("=");
    this.#quantity = answer.quantities.find((one) => one.name === name && one.kind !== "rate");
    const isFirst = figure.hidden;
    if (isFirst) {
      const [from, to] = range.split("..").map((end) => Number.parseFloat(end));
      this.#state.strip = { kind: this.#quantity.kind, name, from, to };
      this.dataset.theme = isDark(this) ? "dark" : "light";
      figure.hidden = false;
      this.shadowRoot.querySelector("slot").hidden = true;
    }
    showVerdict(this.#parts, answer);
    this.#drawings.show(answer.drawings);
    this.#strip.prepare(this.#state.strip, this.#quantity);
    this.#linked();
    if (isFirst) this.#limits(slow, name, range);
  }

  #linked = settled(async () => {
    this.#link.href = `${here("./")}#${await this.#state.address()}`;
  }, 200);

  async #limits(slow, name, range) {
    const reply = await slow.ask(this, {
      ask: "limits",
      ...this.#state.asked(this.#quantity),
      vary: `${name}=${range}`,
    });
    if (reply.answer) this.#strip.show(JSON.parse(reply.answer.json));
  }
}

customElements.define("slideway-live", Live);
