// Where things are on the page, on a desktop and on a phone.

import assert from "node:assert/strict";
import { test } from "node:test";
import { choose, close, gallery, limits, setUp, skip, verdict } from "./browser.js";

const set = setUp();
const DESKTOP = { viewport: { width: 1400, height: 900 } };
const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

/** On the first screen: what is asked, how it is answered, what to drag, and the drawing with its forces. */
const onFirstScreen = (page) =>
  page.evaluate(() =>
    ["#invitation", "#verdict", ".strip-slider", "#drawings figure:nth-child(2)"].map((selector) => {
      const box = document.querySelector(selector).getBoundingClientRect();
      return { selector, top: box.top, bottom: box.bottom, left: box.left, right: box.right };
    }),
  );

for (const [name, options, drawn] of [
  ["a desktop", DESKTOP, 0.9],
  ["a phone", PHONE, 0.5],
]) {
  test(`the first screen of ${name} has the question, the verdict, the slider and the forces`, { skip }, async () => {
    const page = await set.open("", options);
    await limits(page);
    const { width, height } = options.viewport;
    for (const { selector, top: from, bottom, left, right } of await onFirstScreen(page)) {
      const isDrawing = selector.startsWith("#drawings");
      const seen = (Math.min(bottom, height) - Math.max(from, 0)) / (bottom - from);
      assert.ok(seen >= (isDrawing ? drawn : 1), `${selector}: ${seen} of it is seen`);
      assert.ok(left >= 0 && right <= width, `${selector}: from ${left} to ${right}`);
    }
    assert.match(
      await page.textContent("#invitation"),
      /Does it jam\? Drag the friction mu \(friction coefficient of the guide\)/,
    );
    await close(page);
  });
}

/** L / (2 a) = 2/3; two solutions of the paper's example from mu_1 = 0.45265396 (book, chapter Limits). */
for (const [name, options] of [
  ["a desktop", DESKTOP],
  ["a phone", PHONE],
]) {
  test(`on ${name} the strip stays where it is when the number of solutions changes`, { skip }, async () => {
    for (const [address, states] of [
      ["#model=gallery:drawer&vary=parameter~mu~0~1", { 0.62: "one", 0.9: "none", 0.1: "one" }],
      [
        "#model=gallery:klepp-2002&set=F_20%3D0&vary=parameter~mu_1~0~0.8",
        { 0.5: "several", 0.1: "one", 0.7: "several" },
      ],
    ]) {
      const page = await set.open(address, options);
      await limits(page);
      const slider = page.locator(".strip-slider");
      const place = () =>
        slider.evaluate((element) => [element, document.getElementById("pictures")].map((one) => one.offsetTop));
      const places = [];
      for (const [value, status] of Object.entries(states)) {
        await slider.fill(value);
        await verdict(page, status);
        places.push(await place());
      }
      // Places are rounded to pixels.
      for (const other of places.slice(1))
        assert.ok(other.every((at, one) => Math.abs(at - places[0][one]) <= 1), JSON.stringify(places));
      await close(page);
    }
  });
}

test("the values end above the model, wherever one has scrolled", { skip }, async () => {
  const page = await set.open("#model=gallery:bracket-on-pole", { viewport: { width: 1280, height: 900 } });
  for (let scrolled = 0; scrolled < 1500; scrolled += 150) {
    await page.evaluate((to) => scrollTo(0, to), scrolled);
    const [values, model] = await page.evaluate(() =>
      ["#values .scrolled", "#model"]
        .map((of) => document.querySelector(of).getBoundingClientRect())
        .map(({ top: from, bottom }) => [from, bottom]),
    );
    assert.ok(
      values[1] <= model[0] + 0.5,
      `scrolled by ${scrolled}: values end at ${values[1]}, the model begins at ${model[0]}`,
    );
  }
  await close(page);
});

test("nothing is wider than a phone", { skip }, async () => {
  const page = await set.open("#model=gallery:klepp-2002", {
    viewport: { width: 360, height: 740 },
    hasTouch: true,
    isMobile: true,
  });
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= 361, `${width}`);
  await close(page);
});

test("the mark of the present value covers no words of the strip", { skip }, async () => {
  for (const options of [DESKTOP, PHONE]) {
    const page = await set.open("#model=gallery:klepp-2002&set=F_20%3D0&vary=parameter~mu_1~0~0.8", options);
    await limits(page);
    // In the middle of the words "1 solution", below mu_1 = 0.45265396.
    await page.locator(".strip-slider").fill("0.22");
    await page.waitForFunction(() => document.querySelector(".present text").textContent === "0.22");
    const [mark, words] = await page.evaluate(() =>
      [".present line, .present circle", ".count-text"].map((of) =>
        [...document.querySelectorAll(of)].map((one) => {
          const { left, right, top: from, bottom } = one.getBoundingClientRect();
          // The line of letters, without the space below it.
          return { left, right, from, bottom: one.matches("text") ? bottom - 0.24 * (bottom - from) : bottom };
        }),
      ),
    );
    const middle = (of) => (of.left + of.right) / 2;
    assert.ok(words.some((word) => Math.abs(middle(word) - middle(mark[0])) < 20));
    for (const part of mark)
      for (const word of words)
        assert.ok(
          part.right < word.left || word.right < part.left || part.bottom <= word.from || word.bottom <= part.from,
          JSON.stringify([part, word]),
        );
    await close(page);
  }
});

/** How far drawings are wider than a phone: the labels of this one need a place of their own beside it. */
const WIDER = { "telescopic-boom": 30 };

test("drawings are seen whole on a phone, moving and jammed", { skip }, async () => {
  const page = await set.open("#model=gallery:drawer", PHONE);
  const fits = async (name) => {
    const wide = await page.evaluate(() =>
      [...document.querySelectorAll("#drawings figure")].map((figure) => figure.scrollWidth - figure.clientWidth),
    );
    assert.ok(Math.max(...wide) <= (WIDER[name] ?? 1), `${name}: wider than their frames by ${wide}`);
  };
  await limits(page);
  for (const mu of ["0.4", "0.62", "0.67", "0.8"]) {
    await page.locator(".strip-slider").fill(mu);
    await verdict(page, mu < 2 / 3 ? "one" : "none");
    await fits(`drawer, mu = ${mu}`);
  }
  for (const name of gallery) {
    await choose(page, name);
    await fits(name);
  }
  await choose(page, "slider-crank");
  // It is turned, and another one is narrower.
  const shown = () => page.evaluate(() => Number(document.documentElement.dataset.shown));
  const areWhole = () =>
    [...document.querySelectorAll("#drawings figure")].every((figure) => figure.scrollWidth - figure.clientWidth <= 1);
  for (const viewport of [
    { width: 844, height: 390 },
    { width: 360, height: 740 },
  ]) {
    const before = await shown();
    await page.setViewportSize(viewport);
    await page.waitForFunction((count) => Number(document.documentElement.dataset.shown) > count, before);
    // An answer to the question of before, with margins, may come first.
    await page.waitForFunction(areWhole, null, { timeout: 30_000 }).catch(() => {});
    await fits(`${viewport.width} pixels`);
  }
  await close(page);
});

test("texts of drawings have at least 11 pixels on a phone", { skip }, async () => {
  const page = await set.open("", PHONE);
  for (const name of gallery) {
    await choose(page, name);
    const sizes = await page.evaluate(() =>
      [...document.querySelectorAll("#drawings svg, .strip")].flatMap((svg) =>
        [...svg.querySelectorAll("text")].map(
          (one) => Number.parseFloat(getComputedStyle(one).fontSize) * svg.getScreenCTM().a,
        ),
      ),
    );
    assert.ok(sizes.length > 3 && Math.min(...sizes) >= 11 - 1e-6, `${name}: ${Math.min(...sizes)}`);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 391);
  }
  await close(page);
});
