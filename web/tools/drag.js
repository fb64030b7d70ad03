// How the page feels on a slow machine and a slow line; it has been built (tools/build.js):
//
//     node web/tools/drag.js [NAME ..]
//
// For each model of the gallery, or those that are named: how many pictures a second the first drag shows, right after the model was opened, when
// everything is as slow as if the machine were so many times slower, which is little where others use the processors, too; and
// the processor time of the page's main thread for each picture, as fast as the machine is. Before that, how long the first
// picture and the engine take over slow lines.

import { readdirSync } from "node:fs";
import { resolve } from "node:path";
import { setTimeout } from "node:timers/promises";
import { chromium } from "playwright-core";
import { browserProgram, limits, settled } from "../test/browser.js";
import { page as folder, top } from "./places.js";
import { serve } from "./serve.js";

/** So many times slower than this machine. */
const SLOWER = 4;
/** How long is dragged, and how long it is from move to move (ms). */
const DRAG = 2000;
const BETWEEN_MOVES = 16;
/** How long it takes from 0.3 to 0.7 of the length. */
const ONE_WAY = 1000;
/** Lines (Mbit/s), with 100 ms from question to answer. */
const LINES = [1.6, 0.4];
const LATENCY = 100;

const server = await serve(folder);
const site = `http://localhost:${server.address().port}/`;
const browser = await chromium.launch({ executablePath: browserProgram(), args: ["--no-sandbox"] });

/**
 * Makes a worker slower, which the browser can do for the page only: it sleeps before each answer, until that has taken so many
 * times its own time. The processor has nothing to do meanwhile: the page has one of its own.
 */
const slowed = (script) => `{
  const post = self.postMessage.bind(self);
  const never = new Int32Array(new WebAssembly.Memory({ initial: 1, maximum: 1, shared: true }).buffer);
  self.postMessage = (message) => {
    if (message.reply) Atomics.wait(never, 0, 0, ${SLOWER - 1} * message.milliseconds);
    post(message);
  };
}
${script}`;

/** The first drag of a model: pictures a second, and the processor time of the page itself for each (ms). */
async function firstDrag(name, slower) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, serviceWorkers: "block" });
  const page = await context.newPage();
  if (slower) {
    await page.route("**/worker.js", async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, body: slowed(await response.text()) });
    });
  }
  await page.goto(`${site}#model=gallery:${name}`);
  await settled(page);
  await limits(page).catch(() => {});
  const client = await context.newCDPSession(page);
  await client.send("Performance.enable", { timeDomain: "threadTicks" });
  if (slower) await client.send("Emulation.setCPUThrottlingRate", { rate: SLOWER });
  const state = async () => {
    const { metrics } = await client.send("Performance.getMetrics");
    const [pictures, now] = await page.evaluate(() => [
      Number(document.documentElement.dataset.shown),
      performance.now(),
    ]);
    return { pictures, now, spent: 1000 * metrics.find((metric) => metric.name === "TaskDuration").value };
  };
  const box = await page.locator(".strip-slider").boundingBox();
  const at = (part) => [box.x + (0.3 + 0.4 * part) * box.width, box.y + box.height / 2];
  await page.mouse.move(...at(0));
  await page.mouse.down();
  const before = await state();
  await moved(client, at);
  const after = await state();
  await page.mouse.up();
  await context.close();
  const count = after.pictures - before.pictures;
  return { rate: (1000 * count) / (after.now - before.now), each: (after.spent - before.spent) / Math.max(1, count) };
}

/**
 * Moves the mouse to and fro, as a hand does, which does not wait for the page: each way takes so long that every move is one to
 * another of the 200 values of a slider, since without another value there is no other picture.
 */
async function moved(client, at) {
  const heard = [];
  const begun = performance.now();
  for (let spent = 0; spent < DRAG; spent = performance.now() - begun) {
    const way = (spent / ONE_WAY) % 2;
    const [x, y] = at(Math.min(way, 2 - way));
    const move = { type: "mouseMoved", x, y, button: "left", buttons: 1 };
    heard.push(client.send("Input.dispatchMouseEvent", move));
    await setTimeout(BETWEEN_MOVES);
  }
  await Promise.all(heard);
}

/** Time until the first picture over a line, and until the engine is there (s), and what came (MB). */
async function firstPicture(megabits) {
  const context = await browser.newContext({ serviceWorkers: "block" });
  const page = await context.newPage();
  const client = await context.newCDPSession(page);
  let bytes = 0;
  client.on("Network.loadingFinished", ({ encodedDataLength }) => {
    bytes += encodedDataLength;
  });
  await client.send("Network.enable");
  const throughput = (megabits * 1e6) / 8;
  await client.send("Network.emulateNetworkConditions", {
    offline: false,
    latency: LATENCY,
    downloadThroughput: throughput,
    uploadThroughput: throughput,
  });
  const begun = performance.now();
  await page.goto(site, { waitUntil: "commit", timeout: 120_000 });
  const until = async (...states) => {
    await page.waitForFunction((wanted) => wanted.includes(document.documentElement.dataset.state), states, {
      timeout: 300_000,
    });
    return { seconds: (performance.now() - begun) / 1000, megabytes: bytes / 1e6 };
  };
  const found = { picture: await until("prepared", "shown"), engine: await until("shown") };
  await context.close();
  return found;
}

const say = (text) => process.stdout.write(`${text}\n`);
for (const megabits of LINES) {
  const { picture, engine } = await firstPicture(megabits);
  const after = ({ seconds, megabytes }) => `after ${seconds.toFixed(1)} s, ${megabytes.toFixed(2)} MB`;
  say(`${megabits} Mbit/s: the first picture ${after(picture)}; the engine ${after(engine)}`);
}
const all = [];
const gallery = readdirSync(resolve(top, "models")).map((file) => file.slice(0, -".toml".length));
const named = process.argv.slice(2);
for (const name of named.length > 0 ? named : gallery) {
  const { rate } = await firstDrag(name, true);
  const { each } = await firstDrag(name, false);
  all.push({ name, rate, each });
  say(`${name}: ${rate.toFixed(0)} pictures a second, ${each.toFixed(1)} ms of processor time for each`);
}
const median = (of) => all.map(of).sort((a, b) => a - b)[Math.floor(all.length / 2)];
say(`median: ${median(({ rate }) => rate).toFixed(0)} pictures a second, ${median(({ each }) => each).toFixed(1)} ms`);
await browser.close();
server.close();
