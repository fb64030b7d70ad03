// Engines in workers: asked one question at a time, and ended if they take too long.

import { withNextFrame } from "./dom.js";

/** A question was ended before it was answered. */
export class Ended extends Error {}

/** How long after its time a question is ended that does not end by itself (s). */
const GRACE = 3;

let compiled;
const listeners = new Set();

/** The module of the engine, compiled once; a promise. `progress(bytes)` learns how much of it has come, of ENGINE_BYTES. */
export function load(address, progress) {
  listeners.add(progress);
  compiled ??= fetch(address).then((response) => {
    if (!response.ok) throw new Error(`${address}: ${response.status} ${response.statusText}`);
    let bytes = 0;
    const counted = response.body.pipeThrough(
      new TransformStream({
        transform(part, through) {
          bytes += part.length;
          for (const told of listeners) told(bytes);
          through.enqueue(part);
        },
      }),
    );
    // A server may not know the type of the file.
    return WebAssembly.compileStreaming(new Response(counted, { headers: { "content-type": "application/wasm" } }));
  });
  return compiled;
}

/** An engine in a worker of its own, which answers questions in their order. */
export class Engine {
  #module;
  #script;
  #worker = null;
  /** The questions without an answer; the first of them is being answered. */
  #asked = [];
  #number = 0;

  /** `module`: what `load` promises. */
  constructor(module, script) {
    this.#module = module;
    this.#script = script;
  }

  /** Starts the worker, if it does not run: before the first question, so that it is ready for it. */
  begin() {
    if (this.#worker) return;
    const worker = new Worker(this.#script, { type: "module" });
    worker.onmessage = ({ data }) => this.#hear(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.#fail(new Error(`the engine stopped: ${event.message}`));
    };
    this.#worker = worker;
    // The worker starts while the module is still being read.
    this.#module.then(
      (module) => worker.postMessage({ module }),
      (error) => this.#fail(new Error(`the engine cannot be loaded: ${error.message}`)),
    );
  }

  #hear({ number, progress, reply, broken, ended, milliseconds }) {
    const [asked] = this.#asked;
    if (asked?.number !== number) return;
    if (progress) {
      asked.progress?.(progress);
    } else if (broken !== undefined) {
      this.#fail(new Error(`the engine stopped: ${broken}`));
    } else {
      this.#asked.shift();
      clearTimeout(asked.timer);
      this.#watch();
      if ("stopped" in reply) asked.reject(new Ended("it took too long"));
      else asked.resolve({ ...reply, ended, milliseconds });
    }
  }

  /** The worker may be in any state: another one takes its place, and goes on with the questions after the first. */
  #fail(error) {
    this.#worker?.terminate();
    this.#worker = null;
    const asked = this.#asked.shift();
    clearTimeout(asked?.timer);
    asked?.reject(error);
    if (!this.isBusy) return;
    this.begin();
    for (const next of this.#asked) this.#post(next);
    this.#watch();
  }

  #post({ number, question, seconds }) {
    this.#worker.postMessage({ number, question, seconds });
  }

  /** Whether a question waits for its answer. */
  get isBusy() {
    return this.#asked.length > 0;
  }

  /** Ends the question that is being answered, if there is one. */
  end() {
    if (this.isBusy) this.#fail(new Ended("ended"));
  }

  /** Ends all questions. */
  cancel() {
    const others = this.#asked.splice(1);
    this.end();
    for (const { reject } of others) reject(new Ended("ended"));
  }

  /**
   * The answer to a question, after those before it.
   *
   * @param {object} question
   * @param {{ seconds?: number, progress?: (progress: object) => void }} options
   */
  ask(question, { seconds = 20, progress } = {}) {
    const number = ++this.#number;
    return new Promise((resolve, reject) => {
      this.begin();
      const asked = { number, question, seconds, resolve, reject, progress };
      this.#asked.push(asked);
      this.#post(asked);
      if (this.#asked.length === 1) this.#watch();
    });
  }

  /** Ends the question that is being answered once its time is over. */
  #watch() {
    const [asked] = this.#asked;
    // On a slow line the engine itself comes late: the time begins when it is there.
    this.#module.then(
      () => {
        if (!asked || this.#asked[0] !== asked) return;
        asked.timer = setTimeout(() => this.#fail(new Ended("it took too long")), 1000 * (asked.seconds + GRACE));
      },
      () => {},
    );
  }
}

/** So many questions the engine has at once: it begins with the next answer while this page still draws the last one. */
const AHEAD = 2;

/**
 * Asks for the newest of many questions: while the engine has enough of them only the latest of the others is kept, and one that
 * takes long is ended for it. The newest of the answers is shown when the screen is drawn again.
 */
export class Newest {
  #engine;
  #patience;
  /** What the engine has; the first of it is being answered, since when. */
  #asked = [];
  #begun = 0;
  #next = null;
  #timer;

  /** `patience`: how long a question may take while another one waits (ms). */
  constructor(engine, patience = 1500) {
    this.#engine = engine;
    this.#patience = patience;
  }

  /** Asks for what `make` gives when its turn comes; `take` gets the reply, `fail` the error. */
  want(make, take, fail) {
    this.#next = { make, take, fail };
    this.#ask();
    this.#hurry();
  }

  /** Ends what takes long while something else waits; looks again later. */
  #hurry() {
    clearTimeout(this.#timer);
    if (this.#asked.length < 2 && !this.#next) return;
    const left = this.#begun + this.#patience - performance.now();
    if (left > 0) {
      this.#timer = setTimeout(() => this.#hurry(), left);
      return;
    }
    this.#engine.end();
  }

  /** Asks what is wanted now, if anything is, unless the engine has enough. */
  #ask() {
    if (!this.#next || this.#asked.length === AHEAD) return;
    const asked = this.#next;
    this.#next = null;
    const { question, options } = asked.make();
    if (this.#asked.length === 0) this.#begun = performance.now();
    this.#asked.push(asked);
    const answered = (answer) => {
      if (this.#asked[0] !== asked) return;
      this.#asked.shift();
      this.#begun = performance.now();
      this.#ask();
      // What is not the newest is shown, too: the picture follows.
      this.#show({ ...answer, question, ...asked });
    };
    this.#engine.ask(question, options).then(
      (reply) => answered({ reply }),
      (error) => answered({ error }),
    );
  }

  #show = withNextFrame(({ reply, error, question, take, fail }) => {
    try {
      if (error) throw error;
      take(reply, question);
    } catch (caught) {
      if (!this.#engine.isBusy) fail(caught);
    }
  });
}

/**
 * Asks one question after the other. One of the same kind as another that has no answer yet takes its place: that one is
 * ended.
 */
export class Turns {
  #engine;
  #waiting = [];
  #running = null;

  constructor(engine) {
    this.#engine = engine;
  }

  /** The answer to a question of a kind. */
  ask(kind, question, options) {
    this.end(kind);
    return new Promise((resolve, reject) => {
      this.#waiting.push({ kind, question, options, resolve, reject });
      this.#run();
    });
  }

  /** Ends the questions of a kind; all of them without one. */
  end(kind) {
    const isMeant = (turn) => kind === undefined || turn.kind === kind;
    for (const turn of this.#waiting.filter(isMeant)) turn.reject(new Ended("ended"));
    this.#waiting = this.#waiting.filter((turn) => !isMeant(turn));
    if (this.#running && isMeant(this.#running)) this.#engine.cancel();
  }

  async #run() {
    if (this.#running || this.#waiting.length === 0) return;
    const turn = (this.#running = this.#waiting.shift());
    await this.#engine.ask(turn.question, turn.options).then(turn.resolve, turn.reject);
    this.#running = null;
    this.#run();
  }
}
