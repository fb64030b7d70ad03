// Live figures for other pages:
//
//     <script type="module" src="page/embed.js"></script>
//     <slideway-live model="klepp-2002" set="F_20=0" vary="mu_1=0..0.8">
//       <img src="static.svg" alt="what the figure shows">
//     </slideway-live>
//
// What stands inside is shown where scripts are off, and until the engine is there, which is fetched once a figure comes
// near. If that fails, or the figure asks for what there is not, it stays, and the reason stands below it.

import { element, inWords, settled } from "./dom.js";
import { Drawings, grown, widest } from "./drawings.js";
import { withUnit } from "./numbers.js";
import { key } from "./sliders.js";
import { REST, State, changesOf } from "./state.js";
import { Strip, limitsQuestion } from "./strip.js";
import { Verdict, verdictElements } from "./verdict.js";
import { Engine, Newest, Turns, load } from "./workers.js";

const here = (name) => new URL(name, import.meta.url).href;
let shared;

/** What all figures of a page share: an engine for questions that take longer, and the models to begin with. */
async function share(module) {
  const slow = new Turns(new Engine(module, here("worker.js")));
  const response = await fetch(here("library.json"));
  if (!response.ok) throw new Error(`library.json: ${response.status} ${response.statusText}`);
  return { slow, library: await response.json() };
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
  #quantity = null;
  /** What drawings keep while values change. */
  #held = null;
  #most = widest();
  #slow;
  #newest;
  #drawings;
  #strip;
  #verdict;
  #static = element("slot");
  #loading = element("progress", { max: ENGINE_BYTES, value: 0, "aria-label": "Loading", hidden: true });
  #notice = element("p", { role: "status" });
  #pictures = element("div", { id: "drawings", role: "list", "aria-label": "The mechanism and its solutions" });
  #link = element("a", { href: here("./") }, "Open in the page");
  #figure = element("div", { class: "live", hidden: true });

  connectedCallback() {
    // It may be moved to another place of its page.
    if (this.shadowRoot) return;
    this.attachShadow({ mode: "open" }).append(this.#static, this.#loading, this.#notice, this.#figure);
    const watch = new IntersectionObserver(
      ([entry]) => {
        if (!entry.isIntersecting) return;
        watch.disconnect();
        this.#begin().catch((error) => this.#refuse(error.message));
      },
      { rootMargin: "200px" },
    );
    watch.observe(this);
  }

  /** The figure cannot be live: what stands inside stays. */
  #refuse(why) {
    this.#loading.hidden = true;
    this.#notice.textContent = `This figure is not live: ${why.replace(/\.$/, "")}.`;
  }

  async #begin() {
    this.#loading.hidden = false;
    const module = load(here("engine.wasm"), (bytes) => {
      this.#loading.value = bytes;
    });
    shared ??= share(module);
    const { slow, library } = await shared;
    const engine = new Engine(module, here("worker.js"));
    this.#slow = slow;
    this.#newest = new Newest(engine);
    this.#state = await this.#asked(library);
    this.#figure.append(...verdictElements());
    this.#verdict = new Verdict(this.#figure, () => {
      engine.cancel();
      slow.end(this);
    });
    this.#drawings = new Drawings(this.#pictures);
    this.#strip = new Strip(
      this.#figure,
      (value) => {
        this.#state.changes.set(key(this.#quantity), withUnit(value, this.#quantity.unit));
        this.#look();
      },
      (words) => this.#verdict.near(words),
    );
    this.#figure.append(this.#pictures, element("p", {}, this.#link));
    const styles = ["drawing.css", "style.css"].map((name) => element("link", { rel: "stylesheet", href: here(name) }));
    this.shadowRoot.prepend(...styles);
    this.#look();
  }

  /** The state that the attributes ask for. */
  async #asked(library) {
    const state = await State.of(new URLSearchParams({ model: `gallery:${this.getAttribute("model")}` }), library);
    if (state.unread.length > 0) throw new Error(`there is no model ${this.getAttribute("model")}`);
    for (const setting of (this.getAttribute("set") ?? "").split(";").filter((text) => text.trim())) {
      const [name, value] = setting.split("=").map((part) => part.trim());
      state.changes.set(`parameter ${name}`, value ?? "");
    }
    return state;
  }

  /** What is varied, from the first answer: the quantity and the ends of the strip, which are in its unit. */
  #vary(quantities) {
    const text = this.getAttribute("vary") ?? "";
    const [name, range = ""] = text.split("=").map((part) => part.trim());
    const quantity = quantities.find((one) => one.name === name && one.kind !== "rate");
    if (!quantity) throw new Error(`vary="${text}" names no quantity of this model`);
    const ends = range.split("..").map((end) => /^\s*([-+.\deE]+)\s*(.*?)\s*$/.exec(end) ?? []);
    const [from, to] = ends.map(([, number]) => Number(number));
    const isRead = ends.every(([, , unit]) => unit === "" || unit === quantity.unit);
    if (!(ends.length === 2 && isRead && from < to))
      throw new Error(
        `vary="${text}" has no range such as ${name}=${quantity.from}..${withUnit(quantity.to, quantity.unit)}`,
      );
    this.#state.strip = { kind: quantity.kind, name, from, to };
  }

  #look() {
    this.#want(false);
    this.#thoroughly();
  }

  /** When values rest it is said, too, how much more friction would make it jam. */
  #thoroughly = settled(() => this.#want(true), REST);

  #want(margins) {
    this.#newest.want(
      () => ({
        question: { ask: "look", ...this.#state.asked(), margins, held: this.#held, most: this.#most },
        options: { seconds: 10, progress: (done) => this.#verdict.progress(done) },
      }),
      (reply, question) => this.#took(reply, question),
      (error) => this.#failed(error),
    );
  }

  #failed(error) {
    if (!this.#quantity) return this.#refuse(error.message);
    this.#verdict.fail(error);
    this.#pictures.classList.add("stale");
  }

  #took({ answer, faults }, question) {
    if (faults) return this.#atFault(faults, question.settings);
    this.#pictures.classList.remove("stale");
    if (answer.answer) this.#held = grown(this.#held, answer.held);
    const isFirst = !this.#quantity;
    if (isFirst) this.#begun(answer);
    this.#quantity = answer.quantities.find((one) => key(one) === key(this.#state.strip));
    this.#verdict.show(answer);
    this.#drawings.show(answer.drawings);
    const name = key(this.#quantity);
    const isNewest = changesOf(question.settings).get(name) === this.#state.changes.get(name);
    this.#strip.prepare(this.#state.strip, this.#quantity, isNewest);
    this.#linked();
    if (isFirst) this.#limits();
  }

  /** With the settings that are at fault before their faults. */
  #atFault(faults, settings) {
    const words = faults.map((fault) => {
      const setting = settings[fault.place?.setting];
      return setting ? `${setting.name}=${setting.value}: ${inWords(fault)}` : inWords(fault);
    });
    if (!this.#quantity) return this.#refuse(words.join("; "));
    this.#pictures.classList.add("stale");
    this.#verdict.showFaults(words.map((message) => ({ message })));
  }

  /** The first answer is there: the figure takes the place of what stands inside. */
  #begun(answer) {
    this.#vary(answer.quantities);
    this.dataset.theme = isDark(this) ? "dark" : "light";
    for (const part of [this.#static, this.#loading, this.#notice]) part.hidden = true;
    this.#figure.hidden = false;
  }

  #linked = settled(async () => {
    this.#link.href = `${here("./")}#${await this.#state.address()}`;
  }, 200);

  async #limits() {
    const options = { seconds: 60, progress: (done) => this.#verdict.progress(done) };
    try {
      this.#strip.took(await this.#slow.ask(this, limitsQuestion(this.#state, this.#quantity), options));
    } catch (error) {
      this.#strip.refuse(`Not known: ${error.message}.`);
    } finally {
      this.#verdict.rest();
    }
  }
}

customElements.define("slideway-live", Live);
