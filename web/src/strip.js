// A strip that shows for which values of one quantity each mode exists, and how many solutions there are, with the present
// value, which can be dragged.

import { element, inWords, put, say, shape, withNextFrame } from "./dom.js";
import { setEnds } from "./sliders.js";
import { scale as slider, short, ticks, withUnit } from "./numbers.js";

const ROW = 26;
const TOP = 22;
const LEFT = 96;
const RIGHT = 16;
const COUNTS = 34;
/** Colours of modes, in the order in which they come. */
const COLOURS = 8;

/** What can be along the strip. */
export const eligibleOf = (quantities) => quantities.filter(({ kind }) => kind !== "rate");

/** The strip of a quantity: { kind, name, from, to } in its unit. */
export function along({ kind, name, from, to }) {
  const ends = slider(from, to);
  return { kind, name, from: ends.from, to: ends.to };
}

/** The strip to begin with: of the first coefficient of friction, if there is one. */
export function stripOf(quantities) {
  const eligible = eligibleOf(quantities);
  const first = eligible.find(({ is_friction, is_computed }) => is_friction && !is_computed) ?? eligible[0];
  return first ? along(first) : null;
}

/** Asks for the limits of the quantity along the strip, which do not depend on its value. */
export const limitsQuestion = (state, quantity) => {
  const { name, from, to } = state.strip;
  const range = [from, to].map((end) => withUnit(end, quantity.unit)).join("..");
  return { ask: "limits", ...state.asked(quantity), vary: `${name}=${range}` };
};

const signs = (pattern) => [...pattern].join(" ").replaceAll("-", "−");

/** So near to values without a solution, as a part of the strip, is said. */
const NEAR = 0.05;
/** How wide a letter is at most, on average. */
const LETTER = 7.5;

/** The limits of rest as those of motion: a stretch that holds counts as one with a solution. */
const asCounts = (report) => {
  if (!report.spans) return report;
  const isKnown = ({ holds }) => holds !== null;
  const counted = ({ holds, ...span }) => ({
    ...span,
    solutions: Number(holds),
    words: holds ? "it holds" : "it does not hold",
  });
  return {
    ...report,
    modes: [],
    counts: report.spans.filter(isKnown).map(counted),
    without_mode_problem: report.spans
      .filter((span) => !isKnown(span))
      .map((span) => ({ reason: "not decided", ...span })),
  };
};

/** How many solutions a stretch has, for its style, and in words. */
const kindOf = ({ solutions, continuum }) => (continuum ? "many" : Math.min(solutions, 3));
const inNumber = ({ solutions, continuum, words }) =>
  words ??
  (continuum
    ? "infinitely many"
    : solutions === 1
      ? "1 solution"
      : solutions === 0
        ? "no solution"
        : `${solutions} solutions`);

/** What exists along the strip, and what each row of it shows: a mode, or how it starts where contacts are at rest. */
const rowsOf = (report) => [
  ...report.modes.map(({ pattern, preload_gap: isGap, from, to }) => ({ name: signs(pattern), isGap, from, to })),
  ...report.counts.flatMap(({ from, to, starts = [] }) => starts.map((words) => ({ words, name: words, from, to }))),
];

export class Strip {
  #svg = shape("svg", { class: "strip", "aria-hidden": "true" });
  #slider;
  #words = element("p", { class: "words" });
  #report = null;
  #vary = null;
  #quantity = null;
  #value = 0;
  #line;
  /** The most modes that were shown of this model: what stands below does not move when there are fewer. */
  #rows = 1;
  /** Kept: to ask the browser for it takes a new layout of the whole page. */
  #width = 600;
  #near;
  #isNear = "";

  /**
   * `change(value)`: the value was dragged, in the unit of the quantity; `near(words)`: it is near to values without a solution, or
   * not any more, where the words are empty.
   */
  constructor(place, change, near) {
    this.#near = near;
    this.#slider = element("input", { type: "range", class: "strip-slider" });
    const follow = withNextFrame((value) => this.#mark(value));
    this.#slider.addEventListener("input", () => {
      const value = Number(this.#slider.value);
      change(value);
      follow(value);
    });
    const drag = (event) => {
      if (event.buttons === 0 && event.type === "pointermove") return;
      const value = this.#valueAt(event.clientX);
      if (value === null) return;
      event.preventDefault();
      this.#svg.setPointerCapture?.(event.pointerId);
      this.#slider.value = value;
      this.#slider.dispatchEvent(new Event("input"));
    };
    this.#svg.addEventListener("pointerdown", drag);
    this.#svg.addEventListener("pointermove", drag);
    this.element = element("div", { class: "strip-box" }, this.#svg, this.#slider, this.#words);
    place.append(this.element);
    new ResizeObserver(() => {
      this.#width = Math.max(260, this.element.clientWidth || 600);
      this.#draw();
    }).observe(this.element);
  }

  /**
   * What is varied, before its limits are known: { name, from, to } and the quantity. `isNewest`: its value is the one that
   * was typed or dragged last, and not one before.
   */
  prepare(vary, quantity, isNewest = true) {
    this.#vary = vary;
    this.#quantity = quantity;
    const { step } = slider(vary.from, vary.to);
    setEnds(this.#slider, { ...vary, step });
    put(this.#slider, "aria-label", `${vary.name}, along the strip`);
    // An answer that comes late does not pull the slider back from under the finger.
    if (isNewest) this.#present(quantity.value);
  }

  /** Shows the limits of a reply, or why there are none. */
  took({ answer, faults }) {
    if (faults) this.refuse(faults.map(inWords).join("; "));
    else this.#show(asCounts(JSON.parse(answer.json)));
  }

  /** There is another model. */
  forget() {
    this.#rows = 1;
    this.#show(null);
  }

  /** Shows the limits; nothing while there are none. */
  #show(report) {
    this.#report = report;
    this.#words.textContent = report ? modesInWords(report, this.#quantity, this.#vary) : "";
    // The picture says the same to those who see it.
    this.#words.classList.add("unseen");
    this.#draw();
  }

  /** Shows why there are none. */
  refuse(text) {
    this.#report = null;
    this.#draw();
    this.#words.textContent = text;
    this.#words.classList.remove("unseen");
  }

  /** Shows the present value (in the unit of the quantity). */
  #present(value) {
    if (!this.#slider.matches(":active")) this.#slider.value = value;
    this.#mark(value);
  }

  #place(value) {
    const { from, to } = this.#vary;
    return LEFT + ((this.#width - LEFT - RIGHT) * (value - from)) / (to - from);
  }

  #valueAt(clientX) {
    if (!this.#vary) return null;
    const box = this.#svg.getBoundingClientRect();
    const part = ((clientX - box.left) * (this.#width / box.width) - LEFT) / (this.#width - LEFT - RIGHT);
    const { from, to } = this.#vary;
    return from + Math.min(1, Math.max(0, part)) * (to - from);
  }

  #mark(value) {
    this.#value = value;
    if (!this.#vary || !this.#line) return;
    const x = this.#place(Math.min(this.#vary.to, Math.max(this.#vary.from, value)));
    put(this.#line, "transform", `translate(${x} 0)`);
    const label = this.#line.querySelector("text");
    say(label, withUnit(value, this.#quantity.unit));
    put(label, "text-anchor", x > this.#width - 60 ? "end" : x < LEFT + 40 ? "start" : "middle");
    put(
      this.#slider,
      "aria-valuetext",
      `${withUnit(value, this.#quantity.unit)}; ${countAt(this.#report, value * this.#quantity.scale)}`,
    );
    const words = this.#edgeNear(value);
    if (words !== this.#isNear) {
      this.#isNear = words;
      this.#near(words);
    }
  }

  /** Words for the nearest value without a solution, if that is near and this one has one. */
  #edgeNear(value) {
    const { name, from, to } = this.#vary;
    const { unit, scale } = this.#quantity;
    const counts = this.#report?.counts ?? [];
    const hasNone = (count) => kindOf(count) === 0;
    const here = counts.find((count) => count.from <= value * scale && value * scale <= count.to);
    if (!here || hasNone(here)) return "";
    const edges = counts
      .filter(hasNone)
      .map((count) => [inNumber(count), ...(count.from > value * scale ? ["from", count.from] : ["up to", count.to])])
      .map(([words, side, end]) => ({ words, side, end: end / scale, far: Math.abs(end / scale - value) }))
      .sort((one, other) => one.far - other.far);
    const [edge] = edges;
    if (!edge || edge.far > NEAR * (to - from)) return "";
    return `Near its limit: ${edge.words} ${edge.side} ${name} = ${withUnit(edge.end, unit)}.`;
  }

  /** Words on a stretch of a row, as far as there is space for them. */
  #beside(words, from, to, y) {
    const space = Math.floor((this.#width - RIGHT - LEFT) / LETTER);
    const text = words.length > space ? `${words.slice(0, space - 1)}…` : words;
    const isLeft = from + LETTER * text.length < this.#width - RIGHT;
    return isLeft ? label("start-text", from + 6, y, "start", text) : label("start-text", to - 6, y, "end", text);
  }

  #draw() {
    if (!this.#vary) return;
    const shown = this.#report ? rowsOf(this.#report) : [];
    const rows = [...new Set(shown.map(({ name }) => name))];
    this.#rows = Math.max(this.#rows, rows.length);
    const bottom = TOP + ROW * this.#rows;
    const height = bottom + COUNTS + 24;
    const width = this.#width;
    this.#svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.#svg.setAttribute("height", height);
    this.#svg.replaceChildren(hatching());
    const of = (value) => this.#place(value / this.#quantity.scale);
    for (const count of this.#report?.counts ?? []) {
      const { from, to } = count;
      if (kindOf(count) === 0)
        this.#svg.append(
          shape("rect", {
            class: "none",
            x: of(from),
            y: TOP,
            width: Math.max(1, of(to) - of(from)),
            height: bottom - TOP + COUNTS,
            fill: "url(#hatching)",
          }),
        );
    }
    for (const { from, to, reason } of this.#report?.without_mode_problem ?? []) {
      const gap = shape(
        "rect",
        { class: "without", x: of(from), y: TOP, width: Math.max(1, of(to) - of(from)), height: bottom - TOP + COUNTS },
        shape("title", {}, reason),
      );
      this.#svg.append(gap);
      if (of(to) - of(from) > 90)
        this.#svg.append(label("count-text quiet", (of(from) + of(to)) / 2, bottom + 20, "middle", "no answer"));
    }
    for (const { name, words, isGap, ...ends } of shown) {
      const row = rows.indexOf(name);
      const [from, to] = [
        ends.from ?? this.#vary.from * this.#quantity.scale,
        ends.to ?? this.#vary.to * this.#quantity.scale,
      ].map(of);
      const bar = {
        class: `mode series-${row % COLOURS}${isGap ? " gap" : ""}${words ? " start" : ""}`,
        x: from,
        y: TOP + ROW * row + 4,
        width: Math.max(2, to - from),
        height: ROW - 8,
        rx: 3,
      };
      this.#svg.append(shape("rect", bar, ...(words ? [shape("title", {}, words)] : [])));
      if (words) this.#svg.append(this.#beside(words, from, to, TOP + ROW * (row + 0.5) + 5));
    }
    rows.forEach((name, row) => {
      const isMode = shown.some((one) => one.name === name && !one.words);
      const text = isMode ? name : row === 0 ? "starts" : "";
      this.#svg.append(label("pattern", LEFT - 8, TOP + ROW * (row + 0.5) + 5, "end", text));
    });
    for (const count of this.#report?.counts ?? []) {
      const [start, end] = [count.from, count.to].map(of);
      this.#svg.append(
        shape("rect", {
          class: `count count-${kindOf(count)}`,
          x: start,
          y: bottom + 4,
          width: Math.max(1, end - start - 1),
          height: COUNTS - 12,
        }),
      );
      const words = inNumber(count);
      const short = count.words ? "" : count.continuum ? "∞" : String(count.solutions);
      if (end - start > 16)
        this.#svg.append(
          label(
            "count-text",
            (start + end) / 2,
            bottom + 20,
            "middle",
            end - start > LETTER * words.length ? words : short,
          ),
        );
    }
    this.#svg.append(label("pattern", LEFT - 8, bottom + 20, "end", this.#report?.spans ? "at rest" : "solutions"));
    for (const value of ticks(this.#vary.from, this.#vary.to, Math.max(3, width / 110))) {
      const x = this.#place(value);
      this.#svg.append(
        shape("line", { class: "tick", x1: x, x2: x, y1: bottom + COUNTS - 6, y2: bottom + COUNTS }),
        label("tick-text", x, bottom + COUNTS + 14, "middle", short(value)),
      );
    }
    // Over the words of the counts there is no line.
    this.#line = shape(
      "g",
      { class: "present" },
      shape("line", { y1: 16, y2: bottom + 2 }),
      shape("circle", { cy: bottom + COUNTS - 6, r: 7 }),
      shape("text", { y: 12 }),
    );
    this.#svg.append(this.#line);
    this.#mark(this.#value);
  }
}

const label = (name, x, y, anchor, text) => shape("text", { class: name, x, y, "text-anchor": anchor }, text);

function hatching() {
  const pattern = shape(
    "pattern",
    { id: "hatching", width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
    shape("line", { class: "hatching", x1: 0, x2: 0, y1: 0, y2: 7 }),
  );
  return shape("defs", {}, pattern);
}

/** How many solutions there are at a value (SI units), in words. */
function countAt(report, value) {
  const found = report?.counts.find(({ from, to }) => from <= value && value <= to);
  return found ? inNumber(found) : "";
}

/** The strip for those who do not see it. */
function modesInWords(report, { unit, scale }, { name }) {
  const value = (si) => withUnit(si / scale, unit);
  const counts = report.counts.map((count) =>
    [`from ${value(count.from)} to ${value(count.to)} ${inNumber(count)}`, ...(count.starts ?? [])].join(", "),
  );
  const without = report.without_mode_problem.map(
    ({ from, to, reason }) => `from ${value(from)} to ${value(to)} there is no answer: ${reason}`,
  );
  return `${name}: ${[...counts, ...without].join("; ")}.`;
}
