// How fast the engine is in WebAssembly, compared with a program built by `cargo build --release`:
//
//     node web/tools/speed.js target/release/slideway

import { spawnSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { resolve } from "node:path";
import { start } from "../src/engine.js";
import { engine, top } from "./places.js";

const RUNS = 8;
const program = process.argv[2];
const ask = await start(await WebAssembly.compile(readFileSync(engine)));

/** The shortest of several times (ms). */
function shortest(act) {
  const times = Array.from({ length: RUNS }, () => {
    const begun = performance.now();
    act();
    return performance.now() - begun;
  });
  return Math.min(...times);
}

/** The program with one thread, as a browser's worker has. */
const run =
  (...words) =>
  () =>
    spawnSync(program, words, { cwd: top, stdio: "ignore", env: { ...process.env, RAYON_NUM_THREADS: "1" } });

const startUp = shortest(run("--version"));
for (const file of readdirSync(resolve(top, "models"))) {
  const path = resolve(top, "models", file);
  const text = readFileSync(path, "utf8");
  const look = shortest(() => ask({ ask: "look", text, margins: false }));
  const questions = [
    [{ ask: "solve", text }, ["solve", path]],
    [{ ask: "limits", text, vary: "friction" }, ["limits", path, "--vary", "friction"]],
  ];
  const told = questions.map(([question, words]) => {
    const [here, there] = [shortest(() => ask(question)), shortest(run(...words)) - startUp];
    return `${words[0]} ${here.toFixed(1)} ms, program ${there.toFixed(1)} ms`;
  });
  process.stdout.write(`${file}: picture ${look.toFixed(1)} ms; ${told.join("; ")}\n`);
}
