// A map of two quantities, in which one walks.

import { element, inWords, parsed, shape, themeName } from "./dom.js";
import { key } from "./sliders.js";
import { scale, withUnit } from "./numbers.js";

/** What the colours tell: the words of `--colour-by`. */
const COLOURS = [
  ["solutions", "the number of solutions"],
  ["modes", "which modes exist"],
  ["margin", "the margin of friction"],
  ["jam", "whether it jams"],
  ["motion", "what becomes of the motion"],
  ["effort", "the effort of the drive"],
  ["hold", "whether it holds at rest"],
];
const PIXELS = 160;

export class MapPanel {
  #ask;
  #move;
  #wanted;
  #x = element("select", { "aria-label": "from left to right" });
  #y = element("select", { "aria-label": "from bottom to top" });
  #colours = element(
    "select",
    { "aria-label": "what the colours tell" },
    ...COLOURS.map(([word, meaning]) => element("option", { value: word }, meaning)),
  );
  #draw = element("button", { type: "button" }, "Draw the map");
  #notice = element("p", { class: "quiet", role: "status" });
  #place = element("div", {
    class: "map",
    tabindex: "0",
    role: "application",
    "aria-label": "Map; the arrow keys walk in it",
  });
  #quantities = [];
  #shown = null;

  /**
   * `ask(question)` gives the reply; `move([quantity, value], ..)` sets values; `wanted(map)` learns what is looked at.
   */
  constructor(place, { ask, move, wanted }) {
    this.#ask = ask;
    this.#move = move;
    this.#wanted = wanted;
    const controls = element(
      "p",
      { class: "controls" },
      element("label", {}, "From left to right ", this.#x),
      element("label", {}, " from bottom to top ", this.#y),
      element("label", {}, " colours: ", this.#colours),
      this.#draw,
    );
    place.append(controls, this.#notice, this.#place);
    this.#draw.addEventListener("click", () => this.draw());
    for (const event of ["pointerdown", "pointermove"]) this.#place.addEventListener(event, (at) => this.#drag(at));
    this.#place.addEventListener("keydown", (event) => this.#walk(event));
  }

  /** Which quantities there are, and what is wanted of an address. */
  show(quantities, map) {
    const shape = JSON.stringify(quantities.map(key));
    if (shape !== JSON.stringify(this.#quantities.map(key))) {
      this.#shown = null;
      this.#place.replaceChildren();
      const options = () =>
        quantities
          .filter(({ kind }) => kind !== "rate")
          .map((quantity) => element("option", { value: key(quantity) }, quantity.name));
      this.#x.replaceChildren(...options());
      this.#y.replaceChildren(...options());
      const usual = quantities.filter(({ kind, is_computed }) => kind === "parameter" && !is_computed);
      const first = usual.find(({ is_friction }) => is_friction) ?? usual[0] ?? quantities[0];
      const second = usual.find((quantity) => quantity !== first) ?? first;
      this.#x.value = first ? key(map?.x ?? first) : "";
      this.#y.value = second ? key(map?.y ?? second) : "";
      if (map) this.#colours.value = map.colours;
    }
    this.#quantities = quantities;
    this.#mark();
  }

  #quantity(text) {
    return this.#quantities.find((quantity) => key(quantity) === text);
  }

  /** Asks for the map. */
  async draw() {
    const axes = [this.#x, this.#y].map((select) => this.#quantity(select.value));
    if (axes.some((axis) => !axis) || axes[0] === axes[1]) {
      this.#notice.textContent = "A map needs two different quantities.";
      return;
    }
    const ends = axes.map((axis) => scale(axis.from, axis.to));
    const [x, y] = axes.map((axis, index) => ({
      kind: axis.kind,
      name: axis.name,
      from: ends[index].from,
      to: ends[index].to,
    }));
    this.#wanted({ x, y, colours: this.#colours.value });
    const varied = (axis, { from, to }) => `${axis.name}=${withUnit(from, axis.unit)}..${withUnit(to, axis.unit)}`;
    this.#notice.textContent = "Drawing …";
    try {
      const reply = await this.#ask(
        {
          ask: "map",
          x: varied(axes[0], ends[0]),
          y: varied(axes[1], ends[1]),
          colour_by: this.#colours.value,
          size: [PIXELS, PIXELS],
          theme: themeName(),
        },
        axes,
      );
      if (reply.faults) {
        this.#notice.textContent = reply.faults.map(inWords).join("; ");
        this.#place.replaceChildren();
        this.#shown = null;
        return;
      }
      this.#notice.textContent = "Click, drag, or use the arrow keys to walk in the map: drawing and sliders follow.";
      const [svg] = parsed(reply.answer.svg);
      svg.removeAttribute("height");
      svg.setAttribute("width", "100%");
      this.#place.replaceChildren(svg);
      this.#place.setAttribute("aria-description", reply.answer.text);
      const frame = svg.querySelector(".frame");
      const box = frame.getBBox();
      for (const cross of svg.querySelectorAll(".model")) cross.remove();
      const cross = shape(
        "g",
        { class: "walker" },
        shape("circle", { r: 8 }),
        shape("path", { d: "M-13 0H13M0-13V13" }),
      );
      svg.append(cross);
      this.#shown = { svg, box, axes, ends, cross };
      this.#mark();
    } catch (error) {
      this.#notice.textContent = error.message;
    }
  }

  /** The cross stands at the present values. */
  #mark() {
    if (!this.#shown) return;
    const { box, axes, ends, cross } = this.#shown;
    const parts = axes.map((axis, index) => {
      const value = this.#quantity(key(axis))?.value ?? axis.value;
      return (value - ends[index].from) / (ends[index].to - ends[index].from);
    });
    const isInside = parts.every((part) => part >= -1e-9 && part <= 1 + 1e-9);
    cross.setAttribute(
      "transform",
      `translate(${box.x + parts[0] * box.width} ${box.y + (1 - parts[1]) * box.height})`,
    );
    cross.setAttribute("visibility", isInside ? "visible" : "hidden");
  }

  #drag(event) {
    if (!this.#shown || (event.type === "pointermove" && event.buttons === 0)) return;
    const { svg, box, axes, ends } = this.#shown;
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const parts = [(at.x - box.x) / box.width, 1 - (at.y - box.y) / box.height];
    if (event.type === "pointerdown" && parts.some((part) => part < 0 || part > 1)) return;
    event.preventDefault();
    this.#place.setPointerCapture(event.pointerId);
    this.#set(axes, ends, parts);
  }

  #set(axes, ends, parts) {
    this.#move(
      axes.map((axis, index) => {
        const { from, to, step } = ends[index];
        const part = Math.min(1, Math.max(0, parts[index]));
        return [axis, Number((Math.round((from + part * (to - from)) / step) * step).toPrecision(12))];
      }),
    );
  }

  #walk(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!steps || !this.#shown) return;
    event.preventDefault();
    const { axes, ends } = this.#shown;
    const parts = axes.map((axis, index) => {
      const { from, to, step } = ends[index];
      const value = (this.#quantity(key(axis))?.value ?? axis.value) + steps[index] * step * (event.shiftKey ? 10 : 1);
      return (value - from) / (to - from);
    });
    this.#set(axes, ends, parts);
  }
}
