// The editor, which comes when what is above it is there: it is most of the code of the page.

export class LateEditor {
  #place;
  #change;
  #text = "";
  #faults = [[], ""];
  #editor = null;

  /** As of `Editor`. */
  constructor(place, change) {
    this.#place = place;
    this.#change = change;
  }

  /** Fetches it. */
  async begin() {
    const { Editor } = await import("./editor.js");
    const editor = new Editor(this.#place, this.#change);
    editor.text = this.#text;
    editor.showFaults(...this.#faults);
    this.#editor = editor;
  }

  /** Shows a text that comes from elsewhere. */
  set text(text) {
    if (this.#editor) this.#editor.text = text;
    else this.#text = text;
  }

  /** Underlines the faults that lie in the text. */
  showFaults(faults, text) {
    if (this.#editor) this.#editor.showFaults(faults, text);
    else this.#faults = [faults, text];
  }

  /** Puts the cursor at a place, and the keyboard into the editor. */
  goTo(place) {
    this.#editor?.goTo(place);
  }
}
