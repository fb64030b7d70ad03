// Chromium, and the page in it.

import { existsSync, readdirSync } from "node:fs";
import { delimiter, resolve } from "node:path";
import { after, before } from "node:test";
import { page as folder, top } from "../tools/places.js";
import { serve } from "../tools/serve.js";

const NAMES = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];

/** The program: the one that CHROMIUM names, or the first of the usual names on the path. */
export function browserProgram() {
  const found = process.env.PATH.split(delimiter)
    .flatMap((place) => NAMES.map((name) => resolve(place, name)))
    .find(existsSync);
  const program = process.env.CHROMIUM ?? found;
  if (!program && process.env.SLIDEWAY_REQUIRE_BROWSER)
    throw new Error("SLIDEWAY_REQUIRE_BROWSER is set, but there is no Chromium: install it or name it in CHROMIUM");
  return program;
}

export const skip = browserProgram()
  ? false
  : "there is no Chromium on this machine; name one in CHROMIUM to run these tests";

/** The names of the models of the gallery. */
export const gallery = readdirSync(resolve(top, "models"))
  .filter((name) => name.endsWith(".toml"))
  .map((name) => name.slice(0, -".toml".length));

/** A browser and a server for the tests of a file. */
export function setUp() {
  const set = { at: "", browser: null, open: null };
  let server;
  before(async () => {
    if (skip) return;
    const { chromium } = await import("playwright-core");
    server = await serve(folder);
    set.at = `http://localhost:${server.address().port}/`;
    set.browser = await chromium.launch({ executablePath: browserProgram(), args: ["--no-sandbox"] });
  });
  after(async () => {
    await set.browser?.close();
    server?.close();
  });
  /** The page at an address, once it shows something; it complains of nothing. */
  set.open = async (address = "", options = {}) => {
    const context = await set.browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
    const page = await context.newPage();
    page.complaints = [];
    page.on("console", (message) => message.type() === "error" && page.complaints.push(message.text()));
    page.on("pageerror", (error) => page.complaints.push(error.message));
    page.on("dialog", (dialog) => {
      page.complaints.push(`dialog: ${dialog.message()}`);
      dialog.dismiss();
    });
    await page.goto(`${set.at}${address}`);
    await settled(page);
    return page;
  };
  return set;
}

/** Waits until the page shows a state, or what is wrong with it. */
export const settled = (page) =>
  page.waitForFunction(() => ["shown", "faults", "failed"].includes(document.documentElement.dataset.state), null, {
    timeout: 30_000,
  });

/** Closes a page. */
export const close = (page) => page.context().close();

/** Shows a model of the gallery. */
export async function choose(page, name) {
  const before = await page.evaluate(() => document.documentElement.dataset.begun);
  await page.selectOption("#pick", `gallery:${name}`);
  await page.waitForFunction((then) => document.documentElement.dataset.begun !== then, before);
  await settled(page);
}

/** Waits until the verdict is of this kind. */
export const verdict = (page, status) =>
  page.waitForFunction((wanted) => document.getElementById("verdict-box").dataset.status === wanted, status, {
    timeout: 30_000,
  });

/** Waits until the strip shows limits. */
export const limits = (page) =>
  page.waitForFunction(() => document.querySelectorAll(".strip .count").length > 0, null, { timeout: 60_000 });

/** Marks a slider, so that another element in its place is found out. */
const mark = (slider) =>
  slider.evaluate((element) => {
    element.scrollIntoView({ block: "center" });
    element.marked = true;
    element.isPressed = false;
    element.addEventListener("pointerdown", () => (element.isPressed = true), { once: true });
  });

/** Whether the slider is the element that was marked, and is in the page; its value, ends and step. */
export const marked = (slider) =>
  slider.evaluate((element) => ({
    isSame: element.marked === true && element.isConnected,
    isFocused: document.activeElement === element,
    value: Number(element.value),
    ends: [Number(element.min), Number(element.max)],
    step: Number(element.step),
  }));

/**
 * The way of a pointer over a slider, from its handle to a part of its length, and the handle pressed by `press`; again if an
 * answer moved the handle away from under the pointer before it was pressed, as a person would.
 */
async function pressed(slider, part, press, release) {
  for (let attempt = 0; attempt < 5; attempt++) {
    await mark(slider);
    // Waits until it stands still and nothing covers it.
    await slider.hover({ trial: true });
    const box = await slider.boundingBox();
    const { value, ends } = await marked(slider);
    const at = (share) => ({ x: box.x + 8 + share * (box.width - 16), y: box.y + box.height / 2 });
    const way = [at((value - ends[0]) / (ends[1] - ends[0])), at(part)];
    await press(way[0]);
    if (await slider.evaluate(({ isPressed }) => isPressed)) return way;
    await release();
  }
  throw new Error("the slider cannot be pressed");
}

const STEPS = 20;
const between = (from, to, step) => ({
  x: from.x + ((to.x - from.x) * step) / STEPS,
  y: from.y + ((to.y - from.y) * step) / STEPS,
});
/** Every fifth move waits for two frames, so that answers come between moves. */
const pause = async (page, step) => {
  if (step % 5 === 0)
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
};

/** Drags the handle of a slider to a part of its length, in twenty moves. */
async function drag(page, slider, part, { press, move, release }) {
  const [from, to] = await pressed(slider, part, press, release);
  for (let step = 1; step <= STEPS; step++) {
    await move(between(from, to, step));
    await pause(page, step);
  }
  await release();
}

/** Drags a slider with the mouse. */
export const dragWithMouse = (page, slider, part) =>
  drag(page, slider, part, {
    press: async ({ x, y }) => {
      await page.mouse.move(x, y);
      await page.mouse.down();
    },
    move: ({ x, y }) => page.mouse.move(x, y),
    release: () => page.mouse.up(),
  });

/** Drags a slider with a finger. */
export async function dragWithFinger(page, slider, part) {
  const client = await page.context().newCDPSession(page);
  const touch = (type, ...touchPoints) => client.send("Input.dispatchTouchEvent", { type, touchPoints });
  await drag(page, slider, part, {
    press: (at) => touch("touchStart", at),
    move: (at) => touch("touchMove", at),
    release: () => touch("touchEnd"),
  });
  await client.detach();
}

/** Presses an arrow key so often on a slider that has the focus, as fast as it repeats. */
export async function pressArrows(page, slider, key, count) {
  await mark(slider);
  await slider.focus();
  for (let press = 0; press < count; press++) await page.keyboard.press(key);
}
