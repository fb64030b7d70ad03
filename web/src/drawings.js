// The drawings of the mechanism and of its contact modes.

import { element, parsed } from "./dom.js";

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
