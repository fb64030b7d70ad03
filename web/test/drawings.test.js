// Drawings that follow a slider shape by shape are those that are made anew.

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { resolve } from "node:path";
import { test } from "node:test";
import { build } from "esbuild";
import { start } from "../src/engine.js";
import { engine, top, web } from "../tools/places.js";
import { setUp, skip } from "./browser.js";

const set = setUp();
const ask = await start(await WebAssembly.compile(readFileSync(engine)));
const text = (name) => readFileSync(resolve(top, "models", `${name}.toml`), "utf8");

/** The drawings of states of a model, as they come while a value goes through its range and back. */
function dragged(name) {
  const look = (settings, held) => ask({ ask: "look", text: text(name), settings, margins: false, held }).answer;
  const first = look([], null);
  const quantity = first.quantities.find((one) => one.is_friction && !one.is_computed) ?? first.quantities[0];
  let { held } = first;
  const states = [0.05, 0.3, 0.33, 0.6, 0.95, 0.31, 0.3].map((part) => {
    const value = `${quantity.from + part * (quantity.to - quantity.from)} ${quantity.unit}`;
    const answer = look([{ kind: quantity.kind, name: quantity.name, value }], held);
    held = answer?.held ?? held;
    return answer?.drawings ?? [];
  });
  return [first.drawings, ...states];
}

/** A page without anything in which `made.Drawings` are those of the page. */
async function withDrawings() {
  const { outputFiles } = await build({
    entryPoints: [resolve(web, "src/drawings.js")],
    bundle: true,
    format: "iife",
    globalName: "made",
    write: false,
  });
  const page = await set.browser.newPage();
  await page.evaluate(`${outputFiles[0].text}; globalThis.made = made`);
  return page;
}

test("drawings that follow a slider are those that are made anew, in every model", { skip }, async () => {
  const page = await withDrawings();
  for (const file of readdirSync(resolve(top, "models")).filter((one) => one.endsWith(".toml"))) {
    const name = file.slice(0, -".toml".length);
    const differing = await page.evaluate((states) => {
      const place = () => document.createElement("div");
      const [followed, other] = [place(), place()];
      const drawings = new globalThis.made.Drawings(followed);
      return states.findIndex((state) => {
        drawings.show(state);
        other.replaceChildren();
        new globalThis.made.Drawings(other).show(state);
        return other.innerHTML !== followed.innerHTML;
      });
    }, dragged(name));
    assert.equal(differing, -1, `${name}: state ${differing}`);
  }
  await page.close();
});

test("what does not move stays the same element", { skip }, async () => {
  const page = await withDrawings();
  // Friction from 0.3 to 0.33 of its range.
  const states = dragged("drawer").slice(2, 4);
  const kept = await page.evaluate(([one, other]) => {
    const place = document.createElement("div");
    const drawings = new globalThis.made.Drawings(place);
    drawings.show(one);
    const shapes = () => [...place.children[1].firstChild.children];
    const [before, shown] = [shapes(), shapes().map((shape) => shape.outerHTML)];
    drawings.show(other);
    const same = shapes().filter((shape, index) => shape === before[index]);
    return { same: same.length, all: before.length, changed: same.filter((s, i) => s.outerHTML !== shown[i]).length };
  }, states);
  assert.equal(kept.same, kept.all);
  assert.ok(kept.changed >= 4 && kept.changed < kept.all / 4, `${kept.changed} of ${kept.all} shapes changed`);
  await page.close();
});
