// The engine answers as the command line does: the same JSON for every model of the gallery.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync } from "node:fs";
import { tmpdir } from "node:os";
import { resolve } from "node:path";
import { test } from "node:test";
import { start } from "../src/engine.js";
import { stripOf } from "../src/strip.js";
import { engine, program, top } from "../tools/places.js";

const ask = await start(await WebAssembly.compile(readFileSync(engine)));
const models = readdirSync(resolve(top, "models")).filter((name) => name.endsWith(".toml"));
const text = (name) => readFileSync(resolve(top, "models", name), "utf8");
const setting = (kind, name, value) => ({ kind, name, value });

/** What the command line prints, whatever its exit code says of the answer. */
function told(...words) {
  try {
    return execFileSync(program(), words, {
      cwd: top,
      encoding: "utf8",
      maxBuffer: 1 << 28,
      stdio: ["ignore", "pipe", "ignore"],
    });
  } catch (error) {
    return error.stdout;
  }
}

/**
 * By how much numbers may differ, as a part of the greatest of their kind in the report: sine, cosine and sums are rounded
 * otherwise in WebAssembly than in the program. A unit in the last place is 1e-16; conditions of the gallery are below 1e5.
 */
const ROUNDING = 1e-10;
/** What is nothing but rounding. */
const RESIDUALS = /^(residual|residual_force|residual_moment|energy_drift|.*_drift)$/;

/** The greatest size of numbers under each key. */
function sizes(value, key = "", found = {}) {
  if (typeof value === "number") found[key] = Math.max(found[key] ?? 0, Math.abs(value));
  else if (value && typeof value === "object")
    for (const [name, part] of Object.entries(value)) sizes(part, Array.isArray(value) ? key : name, found);
  return found;
}

/** Both are the same, but for rounding. */
function assertAlike(one, other, size, place = "", key = "") {
  if (typeof one === "number" && typeof other === "number") {
    const bound = RESIDUALS.test(key) ? 1e-9 : ROUNDING * Math.max(size[key], Number.isInteger(one) ? 0 : 1e-12);
    assert.ok(Math.abs(one - other) <= bound, `${place}: ${one} and ${other}`);
  } else if (one && other && typeof one === "object" && typeof other === "object") {
    assert.deepEqual(Object.keys(one), Object.keys(other), place);
    for (const name of Object.keys(one))
      assertAlike(one[name], other[name], size, `${place}.${name}`, Array.isArray(one) ? key : name);
  } else {
    assert.equal(one, other, place);
  }
}

function assertSameJson(json, expected, place) {
  if (json === expected) return;
  assert.ok(json && expected, `${place}: one has no answer`);
  const parsed = JSON.parse(expected);
  assertAlike(JSON.parse(json), parsed, sizes(parsed), place);
}

/** The JSON of both is the same; an empty text where the question has no answer. */
function assertSame(question, ...words) {
  const reply = ask(question);
  const json = told(...words, "--format", "json");
  assertSameJson(reply.answer?.json ?? "", json, words.join(" "));
  return json;
}

test("the program of the command line is built", () => assert.ok(existsSync(program())));

for (const name of models) {
  test(`${name}: solve, check, hold`, () => {
    const file = `models/${name}`;
    assertSame({ ask: "solve", text: text(name) }, "solve", file);
    assertSame({ ask: "check", text: text(name) }, "check", file);
    assertSame({ ask: "hold", text: text(name) }, "hold", file);
  });
  test(`${name}: limits of friction`, () => {
    assertSame({ ask: "limits", text: text(name), vary: "friction" }, "limits", `models/${name}`, "--vary", "friction");
  });
}

test("what a page begins with can be dragged over its length", () => {
  for (const name of models) {
    const asked = (settings = []) => ask({ ask: "look", text: text(name), margins: false, settings });
    const { kind, name: varied, from, to } = stripOf(asked().answer.quantities);
    const { unit } = asked().answer.quantities.find((quantity) => quantity.kind === kind && quantity.name === varied);
    for (const part of [0, 0.25, 0.5, 0.75, 1]) {
      const value = `${from + part * (to - from)} ${unit}`.trim();
      const { faults } = asked([setting(kind, varied, value)]);
      assert.equal(faults, undefined, `${name}, ${varied} = ${value}: ${JSON.stringify(faults)}`);
    }
  }
});

// Loaded at x = 304.8 mm the bracket of height B = 152.4 mm holds from mu_static = B/(2 x) = 0.25 on.
test("where nothing that moves has a mass, rest is the question", () => {
  const asked = { text: text("bracket-on-pole.toml") };
  const { answer } = ask({ ask: "look", ...asked, margins: false });
  assert.ok(answer.is_at_rest);
  assert.equal(answer.answer.status, "one");
  assert.match(answer.answer.words, /^Just self-locking: it holds/);
  assert.deepEqual(
    answer.quantities.filter(({ is_friction }) => is_friction).map(({ name }) => name),
    ["mu_static"],
  );
  const far = ask({ ask: "look", ...asked, margins: false, settings: [setting("parameter", "x", "300 mm")] }).answer;
  assert.equal(far.answer.status, "none");
  // What the command line would do is no advice on the page.
  assert.doesNotMatch(answer.reasons.join(), /slideway/);
  const { spans } = JSON.parse(ask({ ask: "limits", ...asked, vary: "mu_static=0.2..0.3" }).answer.json);
  assert.deepEqual(
    spans.map(({ holds }) => holds),
    [false, true],
  );
  assert.ok(Math.abs(spans[1].from - 0.25) < 1e-8);
});

test("settings count as on the command line", () => {
  const asked = {
    text: text("klepp-2002.toml"),
    settings: [setting("parameter", "F_20", "0"), setting("parameter", "mu_1", "0.6")],
  };
  const json = assertSame(
    { ask: "solve", ...asked },
    "solve",
    "models/klepp-2002.toml",
    "--set",
    "F_20=0",
    "--set",
    "mu_1=0.6",
  );
  assert.equal(JSON.parse(json).count, "2");
});

test("a motion is told as on the command line", () => {
  const question = { ask: "simulate", text: text("stick-slip.toml"), until: "3 s", frames: true, table: true };
  const reply = ask(question);
  assertSameJson(
    reply.answer.json,
    told("simulate", "models/stick-slip.toml", "--until", "3 s", "--format", "json"),
    "simulate",
  );
  const film = JSON.parse(reply.answer.film);
  assert.ok(film.frames.length > 50);
  assert.match(reply.answer.csv, /^t \(s\),/);
});

test("a map is told as on the command line", () => {
  const [x, y] = ["mu=0..1", "L=200 mm..500 mm"];
  const reply = ask({ ask: "map", text: text("drawer.toml"), x, y, colour_by: "margin", size: [40, 30] });
  const file = resolve(mkdtempSync(resolve(tmpdir(), "slideway-")), "map.json");
  told("map", "models/drawer.toml", "--x", x, "--y", y, "--colour-by", "margin", "--size", "40x30", "--output", file);
  assertSameJson(reply.answer.json, readFileSync(file, "utf8"), "map");
});

/** The lengths of the arrows of both normal forces in a drawing of the drawer; a third one is the scale. */
const arrows = ({ svg }) =>
  [...svg.matchAll(/class="s-reaction"><polyline[^>]* points="([^"]*)"\/><polygon[^>]* points="(\S+)/g)]
    .slice(0, 2)
    .map(([, line, tip]) => {
      const [[x, y], [toX, toY]] = [line.split(" ")[0], tip].map((place) => place.split(",").map(Number));
      return Math.hypot(toX - x, toY - y);
    });

/** The push is Q / (1 - 2 mu a / L), and each normal force that times a / L (book, chapter Limits). */
test("arrows grow towards the jam, and the scale is that of the file", () => {
  const asked = (mu, held) => ({
    ask: "look",
    text: text("drawer.toml"),
    settings: [setting("parameter", "mu", String(mu))],
    margins: false,
    held,
  });
  const force = (mu) => (0.75 * 20) / (1 - 1.5 * mu);
  const { answer: first } = ask({ ask: "look", text: text("drawer.toml"), margins: false });
  const [usual] = arrows(first.drawings[1]);
  let { held } = first;
  for (const mu of [0.1, 0.4, 0.5]) {
    const { answer } = ask(asked(mu, held));
    for (const length of arrows(answer.drawings[1]))
      assert.ok(Math.abs(length / usual - force(mu) / force(0.3)) < 1e-3, `mu = ${mu}: ${length}`);
    // A link shows the same as a drag.
    assert.deepEqual(arrows(ask(asked(mu, undefined)).answer.drawings[1]), arrows(answer.drawings[1]));
    held = answer.held;
  }
  // Near the jam an arrow would leave the picture: it is as long as it may be, with two strokes.
  const { answer: near } = ask(asked(0.66, held));
  assert.ok(arrows(near.drawings[1])[0] < 4 * usual);
  assert.match(near.drawings[1].svg, /s-break/);
  const { answer: jammed } = ask(asked(0.7, held));
  assert.match(jammed.drawings[1].title, /Why it jams/);
  assert.match(jammed.drawings[1].svg, /s-cone/);
  assert.deepEqual(jammed.held, held);
});

test("a file that is saved has what was changed, and its comments", () => {
  const file = text("drawer.toml");
  const settings = [setting("parameter", "mu", "0.65"), setting("position", "x", "20 mm")];
  const { answer } = ask({ ask: "save", text: file, settings });
  assert.equal(
    answer,
    file
      .replace("mu = 0.3                  #", "mu = 0.65                 #")
      .replace("[coordinates.x]\n", '[coordinates.x]\nvalue = "20 mm"\n'),
  );
  assert.match(
    ask({ ask: "save", text: file, settings: [setting("parameter", "mu", "1 kg")] }).faults[0].message,
    /mass/,
  );
});

test("faults are those of the command line, at their places", () => {
  const faulty = text("drawer.toml").replace('mu = "mu"', 'mu = "mo"');
  const { faults } = ask({ ask: "solve", text: faulty });
  assert.equal(faults.length, 1);
  assert.match(faults[0].message, /mo/);
  const { from, to } = faults[0].place;
  assert.equal(faulty.slice(from, to), "mo");
});

test("a question that is none is refused", () => {
  assert.match(ask({ ask: "weather" }).malformed, /unknown variant/);
});

test("progress is told, and work can be ended", async () => {
  let calls = 0;
  const impatient = await start(await WebAssembly.compile(readFileSync(engine)), () => ++calls > 3);
  const reply = impatient({ ask: "limits", text: text("klepp-2002.toml"), vary: "mu_1=0..0.8" });
  assert.deepEqual(reply, { stopped: null });
  assert.ok(calls >= 4);
});
