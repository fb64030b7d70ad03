// The drawings of the mechanism and of its contact modes.

import { element, follow, parsed } from "./dom.js";

/** The smallest texts of drawings, in their units, and how large they are at least where space is short (pixels). */
const SMALLEST = 14;
const LEGIBLE = 11;
/** So many times its own size a drawing has at most. */
const LARGE = 1.3;

/**
 * How wide a drawing may be (in its units) to be seen whole on this screen with texts that can be read; `null` where there is
 * space for every one. The style sheet gives a figure this width where it puts them side by side.
 */
export const widest = () =>
  matchMedia("(max-width: 60rem)").matches
    ? Math.floor((Math.min(0.94 * (innerWidth - 23), 480) - 2) * (SMALLEST / LEGIBLE))
    : null;

/**
 * What the next drawings keep of an answer. It was asked for before the last one was shown, so it may not know how much place
 * that took.
 */
export function grown(held, next) {
  if (!held || !next) return next;
  const place = next.place.map((end, index) => (index < 2 ? Math.min : Math.max)(end, held.place[index]));
  return { ...next, place };
}

/** Shows the drawings; of those that change only what is not as before. */
export class Drawings {
  #place;
  #shown = [];

  constructor(place) {
    this.#place = place;
  }

  show(drawings) {
    drawings.forEach(({ svg, words }, index) => {
      const figure = this.#place.children[index];
      if (!figure) {
        this.#place.append(element("figure", { role: "listitem", tabindex: "0", "aria-label": words }, whole(svg)));
      } else if (this.#shown[index] !== svg) {
        // The keyboard stays where it is.
        if (!changed(figure.firstChild, this.#shown[index], svg)) figure.replaceChildren(whole(svg));
        figure.setAttribute("aria-label", words);
      }
    });
    while (this.#place.children.length > drawings.length) this.#place.lastChild.remove();
    this.#shown = drawings.map((drawing) => drawing.svg);
  }
}

/** A drawing as an element. */
function whole(markup) {
  const [svg] = parsed(markup);
  // Where the style sheet asks for it a drawing is at least so large that its texts can be read, and nowhere much larger.
  const { width, height } = svg.viewBox.baseVal;
  for (const [name, length] of [
    ["--legible", (LEGIBLE / SMALLEST) * width],
    ["--legible-height", (LEGIBLE / SMALLEST) * height],
    ["--large", LARGE * width],
  ])
    svg.style.setProperty(name, `${Math.ceil(length)}px`);
  svg.removeAttribute("width");
  svg.removeAttribute("height");
  svg.setAttribute("aria-hidden", "true");
  // Of white space nothing is seen: each child is a line of the markup.
  for (const node of [...svg.childNodes]) if (node.nodeType === Node.TEXT_NODE) node.remove();
  return svg;
}

/**
 * Makes the element of a drawing that of another one of the same size, line by line of the markup, of which each is a shape:
 * while one drags most shapes stay as they are, and the browser need neither read nor measure them anew. Whether that is
 * possible.
 */
function changed(svg, markup, next) {
  const [old, lines] = [markup, next].map((text) => text.trimEnd().split("\n"));
  // All lines but the tags of the drawing itself are children.
  if (old[0] !== lines[0] || svg.children.length !== old.length - 2) return false;
  const least = Math.min(old.length, lines.length) - 1;
  let from = 1;
  while (from < least && old[from] === lines[from]) from += 1;
  let same = 1;
  while (same < least - from && old.at(-1 - same) === lines.at(-1 - same)) same += 1;
  const until = lines.length - same;
  const shapes = [...svg.children].slice(from - 1, old.length - same - 1);
  const wanted = lines.slice(from, until);
  const isNew = wanted.map((line, index) => line !== old[from + index]);
  const made = [...parsed(`<svg>${wanted.filter((_, index) => isNew[index]).join("")}</svg>`)[0].children];
  if (made.length !== isNew.filter(Boolean).length) return false;
  const after = svg.children[old.length - same - 1] ?? null;
  wanted.forEach((_, index) => {
    if (index >= shapes.length) svg.insertBefore(made.shift(), after);
    else if (isNew[index]) follow(shapes[index], made.shift());
  });
  for (const left of shapes.slice(wanted.length)) left.remove();
  return true;
}
