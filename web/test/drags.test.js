// A slider that is dragged goes on being dragged, in every model of the gallery. The longest tests of the page: apart from the
// others, which run at the same time.

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  choose,
  close,
  dragWithFinger,
  dragWithMouse,
  gallery,
  marked,
  pressArrows,
  setUp,
  settled,
  skip,
} from "./browser.js";

const set = setUp();

/**
 * All sliders are tried with SLIDEWAY_EVERY_SLIDER, which takes minutes; else the first of each group of each model, with a
 * finger one of each model.
 */
const tried = process.env.SLIDEWAY_EVERY_SLIDER ? ".row" : ".row:nth-child(2)";

/** The ids of the sliders that are tried, in groups that are open. */
async function slidersTried(page) {
  await page.evaluate(() => {
    for (const group of document.querySelectorAll("#sliders .group")) group.open = true;
  });
  const found = page.locator(`#sliders .group:not([hidden]) ${tried} input[type=range]`);
  return found.evaluateAll((all) => all.map(({ id }) => id));
}

/** Whether the page shows an answer to what was dragged last. */
async function isAnswered(page) {
  await settled(page);
  return page.evaluate(() =>
    ["one", "several", "none"].includes(document.getElementById("verdict-box").dataset.status),
  );
}

/**
 * Drags so many sliders of every model of the gallery, from the first on; `drag` moves one, and gives the value at which it ends,
 * within how many steps.
 */
async function goOn({ most = Infinity, ...options }, drag) {
  const page = await set.open("", options);
  let count = 0;
  for (const name of gallery) {
    await choose(page, name);
    for (const [index, id] of (await slidersTried(page)).slice(0, most).entries()) {
      // What the last one left may be at fault, or without an answer.
      if (index > 0 && !(await isAnswered(page))) await choose(page, name);
      const slider = page.locator(`[id='${id}']`);
      const before = await marked(slider);
      const expected = await drag(page, slider, before);
      const after = await marked(slider);
      assert.ok(after.isSame, `${name}, ${id}: another slider took its place`);
      assert.ok(
        Math.abs(after.value - expected.value) <= expected.within * after.step,
        `${name}, ${id}: at ${after.value}, moved to ${expected.value}`,
      );
      count += 1;
    }
  }
  process.stdout.write(`# ${count} sliders\n`);
  assert.deepEqual(page.complaints, []);
  await close(page);
}

/** Ends at a quarter of the length, or at three quarters of it, whichever is farther. */
const toOtherSide = (drag) => async (page, slider, before) => {
  const [from, to] = before.ends;
  const part = (before.value - from) / (to - from) < 0.5 ? 0.75 : 0.25;
  await drag(page, slider, part);
  const length = (await slider.boundingBox()).width - 16;
  // Within two pixels, or the step of the slider.
  return { value: from + part * (to - from), within: 1 + (2 * (to - from)) / (length * before.step) };
};

test("a slider that is dragged with the mouse goes on being dragged", { skip }, () =>
  goOn({}, toOtherSide(dragWithMouse)),
);

test("a slider that is dragged with a finger goes on being dragged", { skip }, () => {
  const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
  return goOn({ most: process.env.SLIDEWAY_EVERY_SLIDER ? Infinity : 1, ...phone }, toOtherSide(dragWithFinger));
});

test("arrow keys move a slider, each by a step, and it keeps the focus", { skip }, () =>
  goOn({}, async (page, slider, before) => {
    const up = before.value < (before.ends[0] + before.ends[1]) / 2;
    await pressArrows(page, slider, up ? "ArrowRight" : "ArrowLeft", 12);
    await settled(page);
    assert.ok((await marked(slider)).isFocused);
    return { value: before.value + (up ? 12 : -12) * before.step, within: 1 };
  }),
);
