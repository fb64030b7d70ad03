// Chromium, and the page in it.

import { existsSync } from "node:fs";
import { delimiter, resolve } from "node:path";
import { after, before } from "node:test";
import { page as folder } from "../tools/places.js";
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

/** Waits until the verdict is of this kind. */
export const verdict = (page, status) =>
  page.waitForFunction((wanted) => document.getElementById("verdict-box").dataset.status === wanted, status, {
    timeout: 30_000,
  });

/** Waits until the strip shows limits. */
export const limits = (page) =>
  page.waitForFunction(() => document.querySelectorAll(".strip .count").length > 0, null, { timeout: 60_000 });

/** Moves a slider as a finger does: to a value, without waiting for answers. */
export const slide = (page, selector, value) =>
  page.evaluate(
    ([of, to]) => {
      const slider = document.querySelector(of);
      slider.value = to;
      slider.dispatchEvent(new Event("input", { bubbles: true }));
    },
    [selector, value],
  );
