// The drawings of the mechanism and of its contact modes.

import { element, parsed } from "./dom.js";

/** The smallest texts of drawings, in their units, and how large they are at least where space is short (pixels). */
const SMALLEST = 14;
const LEGIBLE = 11;

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
      // Where the style sheet asks for it a drawing is at least so wide that its texts can be read.
      svg.style.setProperty("--legible", `${Math.ceil((LEGIBLE / SMALLEST) * svg.viewBox.baseVal.width)}px`);
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
