// Live figures in other pages, as their readers use them.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { test } from "node:test";
import { start } from "../src/engine.js";
import { engine, top } from "../tools/places.js";
import { close, dragWithFinger, dragWithMouse, marked, setUp, skip } from "./browser.js";

const set = setUp();

/** A page with a figure of these attributes, and a static picture in it. */
async function pageWith(attributes, options = {}) {
  const { route, ...others } = options;
  const context = await set.browser.newContext(others);
  const page = await context.newPage();
  page.complaints = [];
  page.on("pageerror", (error) => page.complaints.push(error.message));
  if (route) await page.route(...route);
  const script = `<script type="module" src="${set.at}embed.js"></script>`;
  const body = `<!doctype html><meta name="viewport" content="width=device-width"><p>Before</p><slideway-live ${attributes}><p id="static">the picture</p></slideway-live>${script}`;
  await page.route("**/figure.html", (request) => request.fulfill({ contentType: "text/html", body }));
  await page.goto(`${set.at}figure.html`);
  return page;
}

const inFigure = (page, selector) => page.locator(`slideway-live ${selector}`);
const verdict = (page, status) => inFigure(page, `#verdict-box[data-status=${status}]`).waitFor({ timeout: 30_000 });
const limits = (page) => inFigure(page, ".strip .count").first().waitFor({ state: "attached", timeout: 30_000 });

/** H. J. Klepp (2002), section 7: without preload two solutions above mu_1 = 0.45265396; the file has 0.5. */
const KLEPP = 'model="klepp-2002" set="F_20=0" vary="mu_1=0..0.8"';

/** The verdict of the engine on that figure, with margins. */
const ask = await start(await WebAssembly.compile(readFileSync(engine)));
const thorough = () => {
  const text = readFileSync(resolve(top, "models/klepp-2002.toml"), "utf8");
  const settings = [{ kind: "parameter", name: "F_20", value: "0" }];
  const words = (margins) => ask({ ask: "look", text, settings, margins }).answer.answer.words;
  assert.notEqual(words(true), words(false));
  return words(true);
};

for (const [name, options, drag] of [
  ["the mouse", {}, dragWithMouse],
  ["a finger", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }, dragWithFinger],
]) {
  test(`a figure of another page is live, and its strip goes on being dragged by ${name}`, { skip }, async () => {
    const page = await pageWith(KLEPP, options);
    await verdict(page, "several");
    assert.ok(!(await page.locator("#static").isVisible()));
    await limits(page);
    assert.match(await inFigure(page, "#verdict-box").textContent(), /Another solution is unstable/);
    // Margins come when values rest.
    await inFigure(page, "#verdict").filter({ hasText: thorough() }).waitFor({ timeout: 30_000 });
    const slider = inFigure(page, ".strip-slider");
    const top = async () => (await slider.boundingBox()).y + (await page.evaluate(() => scrollY));
    const before = await top();
    for (const [part, status] of [
      [0.2, "one"],
      [0.9, "several"],
    ]) {
      await drag(page, slider, part);
      await verdict(page, status);
      const { isSame, value } = await marked(slider);
      assert.ok(isSame);
      assert.ok(Math.abs(value - part * 0.8) <= 0.02, `${value}`);
    }
    assert.equal(await top(), before);
    await page.waitForFunction(() =>
      document.querySelector("slideway-live").shadowRoot.querySelector("a").href.includes("mu_1%3D"),
    );
    assert.deepEqual(page.complaints, []);
    await close(page);
  });
}

test("the picture of a figure stays where scripts are off", { skip }, async () => {
  const page = await pageWith(KLEPP, { javaScriptEnabled: false });
  assert.ok(await page.locator("#static").isVisible());
  await close(page);
});

for (const [attributes, told] of [
  ['model="chair" vary="mu=0..1"', /no model chair/],
  ['model="drawer" vary="nu=0..1"', /names no quantity/],
  ['model="drawer"', /names no quantity/],
  ['model="drawer" vary="mu=1..0"', /no range/],
  ['model="drawer" vary="a=0 mm..200 mm"', /no range such as a=0\.06\.\.0\.6 m/],
  ['model="drawer" set="L=3 kg" vary="mu=0..1"', /L=3 kg: a mass/],
]) {
  test(`a figure that is asked for ${attributes} says what is wrong`, { skip }, async () => {
    const page = await pageWith(attributes);
    await inFigure(page, "> p, p[role=status]").filter({ hasText: told }).waitFor({ timeout: 30_000 });
    assert.ok(await page.locator("#static").isVisible());
    assert.deepEqual(page.complaints, []);
    await close(page);
  });
}

test("a figure without an engine says so, and keeps its picture", { skip }, async () => {
  const page = await pageWith(KLEPP, { route: ["**/engine.wasm", (route) => route.abort()] });
  await inFigure(page, "p[role=status]").filter({ hasText: "engine" }).waitFor({ timeout: 30_000 });
  assert.ok(await page.locator("#static").isVisible());
  await close(page);
});

test("a figure shows that its engine comes, and its time begins when that is there", { skip }, async () => {
  let release;
  const late = new Promise((done) => {
    release = done;
  });
  const page = await pageWith(KLEPP, {
    route: ["**/engine.wasm", (route) => late.then(() => route.continue())],
  });
  await inFigure(page, "progress[aria-label=Loading]").waitFor();
  // Longer than a question may take.
  await page.waitForTimeout(14_000);
  release();
  await verdict(page, "several");
  await inFigure(page, "progress[aria-label=Loading]").waitFor({ state: "hidden" });
  await close(page);
});
