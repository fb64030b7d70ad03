// The engine in a worker: one question after the other, with its progress.

import { start } from "./engine.js";

/** Time between two messages of progress (ms). */
const PAUSE = 80;

let told = 0;
let deadline = Infinity;
let current = 0;

function progress(done, fraction, counted) {
  const now = performance.now();
  if (now - told > PAUSE) {
    told = now;
    postMessage({ number: current, progress: { done, fraction, counted } });
  }
  return now > deadline;
}

let begin;
const engine = new Promise((begun) => {
  begin = begun;
});

onmessage = async ({ data }) => {
  if (data.module) {
    begin(start(data.module, progress));
    return;
  }
  const ask = await engine;
  current = data.number;
  told = performance.now();
  deadline = told + 1000 * data.seconds;
  try {
    const reply = ask(data.question);
    postMessage({
      number: data.number,
      reply,
      milliseconds: performance.now() - told,
      ended: performance.now() > deadline,
    });
  } catch (error) {
    postMessage({ number: data.number, broken: error.message });
  }
};
