// The verdict: what is found at a glance, how sure it is, and why; and the progress of what takes long.

import { element, say } from "./dom.js";
import { Ended } from "./workers.js";

/** What is seen at a glance, for each status. */
const SIGNS = { none: "✕", one: "✓", several: "⚠", unknown: "?", continuum: "∞" };
/** So many faults are listed. */
const MOST = 50;

/** The elements of a verdict, for a figure in another page; those of the page itself are in its text. */
export const verdictElements = () => [
  element(
    "div",
    { id: "verdict-box", "data-status": "working" },
    element("h2", {}, element("span", { id: "verdict", role: "status" })),
    element("p", {}, element("span", { id: "certainty" }), " ", element("span", { id: "edge" })),
    element("ul", { id: "reasons" }),
  ),
  element(
    "div",
    { id: "work", hidden: true },
    element("progress", { id: "progress", max: 1, "aria-label": "Progress" }),
    " ",
    element("span", { id: "progress-words" }),
    " ",
    element("button", { id: "stop", type: "button" }, "Stop"),
  ),
];

export class Verdict {
  #box;
  #words;
  #certainty;
  #edge;
  #reasons;
  #work;
  #bar;
  #counted;
  #sizes;
  #width = 0;
  #height = 0;

  /** Within a document or an element; `stop()`: what takes long is ended. */
  constructor(place, stop) {
    const [box, words, certainty, edge, reasons, work, bar, counted, button] = [
      "verdict-box",
      "verdict",
      "certainty",
      "edge",
      "reasons",
      "work",
      "progress",
      "progress-words",
      "stop",
    ].map((id) => place.querySelector(`#${id}`));
    this.#box = box;
    this.#words = words;
    this.#certainty = certainty;
    this.#edge = edge;
    this.#reasons = reasons;
    this.#work = work;
    this.#bar = bar;
    this.#counted = counted;
    button.addEventListener("click", stop);
    this.#sizes = new ResizeObserver(([{ borderBoxSize }]) => this.#keepHeight(borderBoxSize[0]));
    this.#sizes.observe(box);
  }

  /** What stands below does not move up under the pointer: the box stays as high as it was for this model. */
  #keepHeight({ inlineSize, blockSize }) {
    if (inlineSize !== this.#width) {
      this.#width = inlineSize;
      this.forget();
    } else if (blockSize > this.#height) {
      this.#height = blockSize;
      this.#box.style.minHeight = `${blockSize}px`;
    }
  }

  /** There is another model: the box is as high as it has to be for what is said next. */
  forget() {
    this.#height = 0;
    this.#box.style.minHeight = "";
    // Its size is heard once more, even if that stays.
    this.#sizes.unobserve(this.#box);
    this.#sizes.observe(this.#box);
  }

  #say(status, text, certainty = "", reasons = []) {
    this.rest();
    if (this.#box.dataset.status !== status) this.#box.dataset.status = status;
    // Said again only if it is another.
    say(this.#words, text);
    say(this.#certainty, certainty);
    if (reasons.length + this.#reasons.children.length > 0) this.#reasons.replaceChildren(...reasons);
  }

  /** The present value is near to values without a solution: words for it, or none. */
  near(words) {
    this.#box.toggleAttribute("data-near", words !== "");
    say(this.#edge, words);
  }

  /** The engine has not come yet. */
  begin() {
    this.#say("working", "Loading …");
  }

  /** How many solutions there are, or why that is not known. */
  show({ answer, reasons }) {
    const status = answer ? answer.status : "refused";
    const words = answer ? answer.words : "This question has no answer here.";
    const certainty = !answer
      ? ""
      : answer.partial
        ? "The search was ended early: there may be more."
        : answer.known;
    const why = reasons.map((reason) => element("li", {}, reason));
    this.#say(status, `${SIGNS[status] ?? "–"} ${words}`, certainty, why);
  }

  /** There are faults; `listed(fault)` is the element for one of them in the list. */
  showFaults(faults, listed = ({ message }) => element("li", {}, message)) {
    const count = faults.length === 1 ? "One fault" : `${faults.length} faults`;
    this.#say("faults", `✎ ${count} in the model or the values`, "", faults.slice(0, MOST).map(listed));
  }

  /** There is no answer. */
  fail(error) {
    this.#say("unknown", error instanceof Ended ? `? No answer: ${error.message}.` : `? ${error.message}`);
  }

  /** What takes long is so far. */
  progress({ done, fraction, counted }) {
    this.#work.hidden = false;
    if (fraction === null) this.#bar.removeAttribute("value");
    else this.#bar.value = fraction;
    this.#counted.textContent = `${done} ${counted}`;
  }

  /** Nothing takes long any more. */
  rest() {
    if (!this.#work.hidden) this.#work.hidden = true;
  }
}
