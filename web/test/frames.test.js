// What waits for the next frame of the screen.

import assert from "node:assert/strict";
import { test } from "node:test";
import { withNextFrame } from "../src/dom.js";

/** A screen that draws when it is asked to. */
function screen() {
  let waiting = [];
  globalThis.document = { hidden: false };
  globalThis.requestAnimationFrame = (act) => waiting.push(act);
  return () => {
    const acts = waiting;
    waiting = [];
    for (const act of acts) act();
  };
}

test("only what was given last is shown, once, with the next frame", () => {
  const draw = screen();
  const shown = [];
  const show = withNextFrame((value) => shown.push(value));
  show(1);
  show(2);
  assert.deepEqual(shown, []);
  draw();
  draw();
  assert.deepEqual(shown, [2]);
  show(3);
  draw();
  assert.deepEqual(shown, [2, 3]);
});

test("a page that is not seen does not wait for frames, and what it shows is not undone by an older one", () => {
  const draw = screen();
  const shown = [];
  const show = withNextFrame((value) => shown.push(value));
  show(1);
  document.hidden = true;
  show(2);
  assert.deepEqual(shown, [2]);
  document.hidden = false;
  draw();
  assert.deepEqual(shown, [2]);
});
