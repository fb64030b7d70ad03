// The drawings of the mechanism and of its contact modes, with the verdict above them.

import { element, parsed } from "./dom.js";

/** What is seen at a glance, for each status. */
const SIGNS = { none: "✕", one: "✓", several: "⚠", unknown: "?", infinitely_many: "∞" };

/** Shows how many solutions there are, or why that is not known, in a box with a heading, a line and a list. */
export function showVerdict({ box, verdict, certainty, reasons }, look) {
  const { answer } = look;
  const status = answer ? answer.status : "refused";
  box.dataset.status = status;
  const words = answer ? answer.words : "This question has no answer here.";
  const text = `${SIGNS[status] ?? "–"} ${words}`;
  // Said again only if it is another.
  if (verdict.textContent !== text) verdict.textContent = text;
  certainty.textContent = !answer
    ? ""
    : answer.partial
      ? "The search was ended early: there may be more."
      : answer.complete === "proven"
        ? "The list is proven complete."
        : "That these are all is not proven.";
  reasons.replaceChildren(...look.reasons.map((reason) => element("li", {}, reason)));
}

/** Shows the drawings; those that are as before stay as they are. */
export class Drawings {
  #place;
  #shown = [];

  constructor(place) {
    this.#place = place;
  }

  show(drawings) {
    drawings.forEach((drawing, index) => {
      const old = this.#place.children[index];
      if (old && this.#shown[index] === drawing.svg) return;
      const [svg] = parsed(drawing.svg);
      svg.removeAttribute("width");
      svg.removeAttribute("height");
      const figure = element("figure", { role: "listitem", tabindex: "0", "aria-label": drawing.words }, svg);
      svg.setAttribute("aria-hidden", "true");
      if (old) {
        // The keyboard stays where it is.
        old.replaceChildren(svg);
        old.setAttribute("aria-label", drawing.words);
      } else {
        this.#place.append(figure);
      }
    });
    while (this.#place.children.length > drawings.length) this.#place.lastChild.remove();
    this.#shown = drawings.map((drawing) => drawing.svg);
  }
}
