// A slider and a field for everything that can be changed in a model.

import { element, inWords, put, say } from "./dom.js";
import { scale, short, withUnit } from "./numbers.js";

/** Title, which quantities it has, and whether it is open at first. */
const GROUPS = [
  ["Parameters", (quantity) => quantity.kind === "parameter" && !quantity.is_computed, true],
  ["Position and speed", (quantity) => quantity.kind !== "parameter", true],
  ["Computed from other parameters", (quantity) => quantity.kind === "parameter" && quantity.is_computed, false],
];

export class Sliders {
  #change;
  #rows = new Map();
  #groups;

  /** `change(quantity, text)`: a value was typed or dragged; `null` stands for that of the file. */
  constructor(place, change) {
    this.#change = change;
    this.#groups = GROUPS.map(([title, , open]) =>
      element("details", { class: "group", open, hidden: true }, element("summary", {}, title)),
    );
    place.replaceChildren(...this.#groups);
  }

  /**
   * Shows what there is, with the texts of what was changed, and of what was changed when it was asked for. A row that is
   * there stays the same element: somebody may hold it.
   */
  show(quantities, changes, asked = changes) {
    const rows = new Map(
      quantities.map((quantity) => [key(quantity), this.#rows.get(key(quantity)) ?? new Row(quantity, this.#change)]),
    );
    for (const [name, row] of this.#rows) if (rows.get(name) !== row) row.element.remove();
    this.#rows = rows;
    this.#groups.forEach((group, index) => {
      const inside = quantities.filter(GROUPS[index][1]).map((quantity) => rows.get(key(quantity)).element);
      if (group.hidden !== (inside.length === 0)) group.hidden = inside.length === 0;
      inside.forEach((row, at) => {
        // The first child is the title.
        if (group.children[at + 1] !== row) group.insertBefore(row, group.children[at + 1] ?? null);
      });
    });
    for (const quantity of quantities) {
      const name = key(quantity);
      rows.get(name).show(quantity, changes.get(name), changes.get(name) === asked.get(name));
    }
  }

  /** Forgets all rows: there is another model. */
  clear() {
    for (const { element: row } of this.#rows.values()) row.remove();
    this.#rows.clear();
  }

  /** Marks the fields whose settings are at fault, and those that are changed. */
  showFaults(faults, settings, changes) {
    for (const [name, row] of this.#rows) {
      row.showFault("");
      row.showChange(changes.get(name));
    }
    for (const fault of faults) {
      if (fault.place?.text !== "setting") continue;
      this.#rows.get(key(settings[fault.place.setting]))?.showFault(inWords(fault));
    }
  }
}

/** Sets ends and step of a slider. */
export function setEnds(slider, { from, to, step }) {
  for (const [name, value] of Object.entries({ min: from, max: to, step })) put(slider, name, value);
}

export const key = ({ kind, name }) => `${kind} ${name}`;

class Row {
  #quantity;
  #slider;
  #field;
  #back;
  #fault;
  #meaning;
  #ends = null;
  #isHeld = false;

  constructor(quantity, change) {
    const id = `value-${quantity.kind}-${encodeURIComponent(quantity.name)}`;
    const name = quantity.kind === "rate" ? `rate of ${quantity.name}` : quantity.name;
    this.#slider = element("input", { type: "range", id, "aria-describedby": `${id}-meaning ${id}-fault` });
    this.#field = element("input", {
      type: "text",
      class: "field",
      inputmode: "decimal",
      "aria-label": `${name}, typed`,
      autocomplete: "off",
      spellcheck: "false",
      "aria-describedby": `${id}-fault`,
    });
    this.#back = element(
      "button",
      { type: "button", class: "back", title: "as in the file", "aria-label": `${name} as in the file`, hidden: true },
      "↺",
    );
    this.#fault = element("p", { class: "fault", id: `${id}-fault` });
    this.#slider.addEventListener("input", () =>
      change(this.#quantity, withUnit(Number(this.#slider.value), this.#quantity.unit)),
    );
    this.#slider.addEventListener("pointerdown", () => {
      this.#isHeld = true;
    });
    for (const end of ["pointerup", "pointercancel", "change", "blur"])
      this.#slider.addEventListener(end, () => {
        this.#isHeld = false;
      });
    this.#field.addEventListener("change", () => {
      const text = this.#field.value.trim();
      const bare = text !== "" && Number.isFinite(Number(text));
      change(this.#quantity, text === "" ? null : bare ? withUnit(Number(text), this.#quantity.unit) : text);
    });
    this.#back.addEventListener("click", () => change(this.#quantity, null));
    this.#meaning = element("span", { class: "meaning", id: `${id}-meaning` });
    this.element = element(
      "div",
      { class: "row" },
      element("label", { for: id }, name),
      this.#meaning,
      element("span", { class: "value" }, this.#field, element("span", { class: "unit" }, quantity.unit), this.#back),
      this.#slider,
      this.#fault,
    );
  }

  /** `isNewest`: the answer is to the value that was typed or dragged last, and not to one before. */
  show(quantity, changed, isNewest) {
    this.#quantity = quantity;
    const { value } = quantity;
    say(this.#meaning, quantity.meaning ?? "");
    this.showChange(changed);
    // An answer that comes late does not pull the slider back from under the finger.
    if (!isNewest) return;
    if (!this.#isHeld) this.#setEnds(quantity, changed);
    if (!this.#isHeld && this.#slider.value !== String(value)) this.#slider.value = value;
    put(this.#slider, "aria-valuetext", withUnit(value, quantity.unit));
    if (document.activeElement !== this.#field && this.#field.value !== short(value)) this.#field.value = short(value);
  }

  /** The ends of the slider: as they are, unless the value is outside, or that of the file again. */
  #setEnds({ from, to, value }, changed) {
    const isOutside = this.#ends && (value < this.#ends.from || value > this.#ends.to);
    if (this.#ends && !isOutside && (changed !== undefined || document.activeElement === this.#slider)) return;
    this.#ends = scale(Math.min(from, value), Math.max(to, value));
    setEnds(this.#slider, this.#ends);
  }

  showChange(changed) {
    if (this.#back.hidden !== (changed === undefined)) this.#back.hidden = changed === undefined;
    this.element.classList.toggle("changed", changed !== undefined);
  }

  showFault(text) {
    say(this.#fault, text);
    put(this.#field, "aria-invalid", text !== "");
  }
}
