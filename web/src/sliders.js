// A slider and a field for everything that can be changed in a model.

import { element } from "./dom.js";
import { scale, short, withUnit } from "./numbers.js";

const GROUPS = [
  ["Parameters", (quantity) => quantity.kind === "parameter" && !quantity.is_computed],
  ["Position and speed", (quantity) => quantity.kind !== "parameter"],
  ["Computed from other parameters", (quantity) => quantity.kind === "parameter" && quantity.is_computed],
];

export class Sliders {
  #place;
  #change;
  #rows = new Map();
  #shape = "";

  /** `change(quantity, text)`: a value was typed or dragged; `null` stands for that of the file. */
  constructor(place, change) {
    this.#place = place;
    this.#change = change;
  }

  /** Shows what there is, with the texts of what was changed. */
  show(quantities, changes) {
    const shape = JSON.stringify(
      quantities.map(({ kind, name, unit, is_computed, meaning }) => [kind, name, unit, is_computed, meaning]),
    );
    if (shape !== this.#shape) {
      this.#shape = shape;
      this.#build(quantities);
    }
    for (const quantity of quantities) {
      this.#rows.get(key(quantity)).show(quantity, changes.get(key(quantity)));
    }
  }

  /** Marks the fields whose settings are at fault, and those that are changed. */
  showFaults(faults, settings, changes) {
    for (const [name, row] of this.#rows) {
      row.showFault("");
      row.showChange(changes.get(name));
    }
    for (const { place, message, hint } of faults) {
      if (place?.text !== "setting") continue;
      const setting = settings[place.setting];
      this.#rows.get(key(setting))?.showFault([message, hint].filter(Boolean).join(": "));
    }
  }

  #build(quantities) {
    this.#rows.clear();
    const groups = GROUPS.map(([title, belongs], index) => {
      const rows = quantities.filter(belongs).map((quantity) => {
        const row = new Row(quantity, this.#change);
        this.#rows.set(key(quantity), row);
        return row.element;
      });
      if (rows.length === 0) return "";
      const open = index < 2;
      return element("details", { class: "group", open }, element("summary", {}, title), ...rows);
    });
    this.#place.replaceChildren(...groups);
  }
}

export const key = ({ kind, name }) => `${kind} ${name}`;

class Row {
  #quantity;
  #slider;
  #field;
  #back;
  #fault;
  #ends = null;

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
    this.#field.addEventListener("change", () => {
      const text = this.#field.value.trim();
      const bare = text !== "" && Number.isFinite(Number(text));
      change(this.#quantity, text === "" ? null : bare ? withUnit(Number(text), this.#quantity.unit) : text);
    });
    this.#back.addEventListener("click", () => change(this.#quantity, null));
    const meaning = element("span", { class: "meaning", id: `${id}-meaning` }, quantity.meaning ?? "");
    this.element = element(
      "div",
      { class: "row" },
      element("label", { for: id }, name),
      meaning,
      element("span", { class: "value" }, this.#field, element("span", { class: "unit" }, quantity.unit), this.#back),
      this.#slider,
      this.#fault,
    );
  }

  show(quantity, changed) {
    this.#quantity = quantity;
    const { value } = quantity;
    const isOutside = this.#ends && (value < this.#ends.from || value > this.#ends.to);
    // The ends stay while a slider is dragged.
    if (!this.#ends || (changed === undefined && document.activeElement !== this.#slider) || isOutside) {
      this.#ends = scale(Math.min(quantity.from, value), Math.max(quantity.to, value));
      Object.assign(this.#slider, { min: this.#ends.from, max: this.#ends.to, step: this.#ends.step });
    }
    // An answer that comes late does not pull the slider back from under the finger.
    if (!(document.activeElement === this.#slider && this.#slider.matches(":active"))) this.#slider.value = value;
    this.#slider.setAttribute("aria-valuetext", withUnit(value, quantity.unit));
    if (document.activeElement !== this.#field) this.#field.value = short(value);
    this.showChange(changed);
  }

  showChange(changed) {
    this.#back.hidden = changed === undefined;
    this.element.classList.toggle("changed", changed !== undefined);
  }

  showFault(text) {
    this.#fault.textContent = text;
    this.#field.setAttribute("aria-invalid", text !== "");
  }
}
