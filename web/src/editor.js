// The editor of the model file: colours, numbers of lines, and faults underlined where the engine finds them.

import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import {
  EditorView,
  drawSelection,
  highlightActiveLine,
  highlightSpecialChars,
  keymap,
  lineNumbers,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--muted)" },
  { tag: [tags.propertyName, tags.atom], color: "var(--reaction)" },
  { tag: [tags.string, tags.number], color: "color-mix(in srgb, var(--velocity) 70%, var(--ink))" },
  { tag: tags.bracket, color: "var(--friction)" },
]);

const look = EditorView.theme({
  "&": {
    backgroundColor: "var(--background)",
    color: "var(--ink)",
    border: "1px solid var(--muted)",
    borderRadius: "6px",
    fontSize: "14px",
  },
  "&.cm-focused": { outline: "3px solid var(--reaction)", outlineOffset: "1px" },
  ".cm-scroller": { maxHeight: "70vh", fontFamily: "ui-monospace, 'DejaVu Sans Mono', monospace" },
  ".cm-gutters": { backgroundColor: "var(--background)", color: "var(--muted)", border: "none" },
  ".cm-activeLine": { backgroundColor: "color-mix(in srgb, var(--body) 50%, transparent)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-selectionBackground, &.cm-focused .cm-selectionBackground": {
    backgroundColor: "color-mix(in srgb, var(--reaction) 35%, transparent) !important",
  },
  ".cm-tooltip": {
    backgroundColor: "var(--background)",
    color: "var(--ink)",
    border: "1px solid var(--muted)",
    maxWidth: "40em",
  },
});

export class Editor {
  #view;
  #isSet = false;
  /** The faults that are underlined, as text; those of another text are none. */
  #underlined = null;

  /** `change(text)`: the text was edited. */
  constructor(place, change) {
    // Fields tell of their selection whenever a value is put into them. To look that up for nothing, the editor would have the
    // whole page laid out for every step of a slider.
    const elsewhere = (event) => document.activeElement !== place && event.stopImmediatePropagation();
    addEventListener("selectionchange", elsewhere, { capture: true });
    // In a shadow tree its style sheets are made without style elements, which the page's policy forbids.
    const root = place.attachShadow({ mode: "open" });
    const listener = EditorView.updateListener.of((update) => {
      if (update.docChanged) this.#underlined = null;
      if (update.docChanged && !this.#isSet) change(update.state.doc.toString());
    });
    this.#view = new EditorView({
      root,
      parent: root,
      state: EditorState.create({
        extensions: [
          lineNumbers(),
          lintGutter(),
          history(),
          drawSelection(),
          highlightActiveLine(),
          highlightSpecialChars(),
          StreamLanguage.define(toml),
          syntaxHighlighting(colours),
          keymap.of([...defaultKeymap, ...historyKeymap, ...lintKeymap, indentWithTab]),
          EditorView.contentAttributes.of({
            "aria-label": "Text of the model file",
            "aria-multiline": "true",
            tabindex: "0",
          }),
          EditorView.lineWrapping,
          look,
          listener,
        ],
      }),
    });
  }

  /** Shows a text that comes from elsewhere. */
  set text(text) {
    if (text === this.text) return;
    this.#isSet = true;
    this.#view.dispatch({ changes: { from: 0, to: this.#view.state.doc.length, insert: text } });
    this.#isSet = false;
  }

  get text() {
    return this.#view.state.doc.toString();
  }

  /** Underlines the faults that lie in the text, if it is still the one that was asked about. */
  showFaults(faults, text) {
    if (text !== this.text) return;
    const length = this.#view.state.doc.length;
    const diagnostics = faults
      .filter(({ place }) => place?.text === "model")
      .map(({ place, message, hint, is_warning }) => ({
        from: Math.min(place.from, length),
        to: Math.min(Math.max(place.to, place.from), length),
        severity: is_warning ? "warning" : "error",
        message: hint ? `${message}\n${hint}` : message,
      }));
    const underlined = JSON.stringify(diagnostics);
    if (underlined === this.#underlined) return;
    this.#underlined = underlined;
    this.#view.dispatch(setDiagnostics(this.#view.state, diagnostics));
  }

  /** Puts the cursor at a place, and the keyboard into the editor. */
  goTo(place) {
    const end = Math.min(place.to, this.#view.state.doc.length);
    this.#view.dispatch({ selection: { anchor: Math.min(place.from, end), head: end }, scrollIntoView: true });
    this.#view.focus();
  }
}
