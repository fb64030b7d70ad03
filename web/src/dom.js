// Elements of the page.

/** The element of this id. */
export const byId = (id) => document.getElementById(id);

/**
 * A new element with attributes and children; texts stay texts. Attributes whose names begin with "on" are listeners.
 */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== undefined && value !== null) made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

const SVG = "http://www.w3.org/2000/svg";

/** A new element of a picture. */
export function shape(name, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** A document that is not shown, in which nothing runs or is fetched. */
let unseen;

/** Markup of the engine, in which all text of the model is escaped, as elements. Nothing in it runs: the page's policy. */
export function parsed(markup) {
  unseen ??= document.implementation.createHTMLDocument();
  unseen.body.innerHTML = markup;
  return [...unseen.body.childNodes].map((node) => document.adoptNode(node));
}

/** Makes an element the same as another one, which may take its place; what is as before is not touched. */
export function follow(old, next) {
  const isAlike =
    old.nodeName === next.nodeName &&
    old.childNodes.length === next.childNodes.length &&
    old.attributes?.length === next.attributes?.length &&
    [...(next.attributes ?? [])].every(({ name }) => old.hasAttribute(name));
  if (!isAlike) {
    old.replaceWith(next);
  } else if (old.nodeType === Node.TEXT_NODE) {
    if (old.data !== next.data) old.data = next.data;
  } else {
    for (const { name, value } of next.attributes) put(old, name, value);
    const children = [...next.childNodes];
    [...old.childNodes].forEach((child, index) => follow(child, children[index]));
  }
}

/** Sets an attribute, unless it has this value: browsers work for what is set again, too. */
export const put = (place, name, value) => {
  if (place.getAttribute(name) !== String(value)) place.setAttribute(name, value);
};

/** Puts a text into an element, unless it is there. */
export const say = (place, text) => {
  if (place.textContent !== text) place.textContent = text;
};

/** Shapes of the engine, to stand within a picture. */
export const shapes = (markup) => [...parsed(`<svg>${markup}</svg>`)[0].childNodes];

/** The function, called when it was not asked for during this time (ms). */
export function settled(act, wait) {
  let timer;
  return (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => act(...given), wait);
  };
}

/** What waits for the next frame, with what it is given: all of it asks the browser for that frame once. */
const waiting = new Map();

function draw() {
  const all = [...waiting];
  waiting.clear();
  for (const [act, given] of all) {
    try {
      act(...given);
    } catch (error) {
      // The others are drawn all the same.
      reportError(error);
    }
  }
}

/**
 * The function, called with what was given last right before the screen is drawn again: what the pointer changes by then is laid
 * out together with it.
 */
export function withNextFrame(act) {
  return (...given) => {
    // What is not seen is not drawn.
    if (document.hidden) {
      waiting.delete(act);
      act(...given);
      return;
    }
    if (waiting.size === 0) requestAnimationFrame(draw);
    waiting.set(act, given);
  };
}

/** Which colours the page shows. */
export function themeName() {
  const chosen = document.documentElement.dataset.theme;
  return chosen || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}

/** A fault in words. */
export const inWords = ({ message, hint }) => [message, hint].filter(Boolean).join(": ");
