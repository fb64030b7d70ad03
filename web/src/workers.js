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

/** An engine in a worker of its own. */
export class Engine {
  #module;
  #script;
  #worker = null;
  #asked = null;
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
    const asked = this.#asked;
    if (!asked || asked.number !== number) return;
    if (progress) {
      asked.progress?.(progress);
    } else if (broken !== undefined) {
      this.#fail(new Error(`the engine stopped: ${broken}`));
    } else {
      this.#asked = null;
      clearTimeout(asked.timer);
      if ("stopped" in reply) asked.reject(new Ended("it took too long"));
      else asked.resolve({ ...reply, ended, milliseconds });
    }
  }

  /** The worker may be in any state: another one takes its place. */
  #fail(error) {
    this.#worker?.terminate();
    this.#worker = null;
    const asked = this.#asked;
    this.#asked = null;
    clearTimeout(asked?.timer);
    asked?.reject(error);
  }

  /** Whether a question waits for its answer. */
  get isBusy() {
    return this.#asked !== null;
  }

  /** Ends the question that is being answered, if there is one. */
  cancel() {
    if (this.#asked) this.#fail(new Ended("ended"));
  }

  /**
   * The answer to a question; the one before it is ended.
   *
   * @param {object} question
   * @param {{ seconds?: number, progress?: (progress: object) => void }} options
   */
  ask(question, { seconds = 20, progress } = {}) {
    this.cancel();
    const number = ++this.#number;
    return new Promise((resolve, reject) => {
      const asked = { number, resolve, reject, progress, timer: undefined };
      this.#asked = asked;
      this.begin();
      this.#worker.postMessage({ number, question, seconds });
      // On a slow line the engine itself comes late: the time begins when it is there.
      this.#module.then(
        () => {
          if (this.#asked !== asked) return;
          asked.timer = setTimeout(() => this.#fail(new Ended("it took too long")), 1000 * (seconds + GRACE));
        },
        () => {},
      );
    });
  }
}

/**
 * Asks for the newest of many questions: while one is being answered only the latest of the others is kept, and one that
 * takes long is ended for it. The newest of the answers is shown when the screen is drawn again.
 */
export class Newest {
  #engine;
  #next = null;
  #running = false;
  #begun = 0;
  #patience;

  /** `patience`: how long a question may take while another one waits (ms). */
  constructor(engine, patience = 1500) {
    this.#engine = engine;
    this.#patience = patience;
  }

  /** Asks for what `make` gives when its turn comes; `take` gets the reply, `fail` the error. */
  want(make, take, fail) {
    this.#next = { make, take, fail };
    if (!this.#running) this.#run();
    else if (performance.now() - this.#begun > this.#patience) this.#engine.cancel();
    else setTimeout(() => this.#hurry(), this.#patience);
  }

  #hurry() {
    if (this.#next && performance.now() - this.#begun > this.#patience) this.#engine.cancel();
  }

  async #run() {
    this.#running = true;
    for (let asked = this.#ask(); asked; asked ??= this.#ask()) {
      const { question, take, fail, replied } = asked;
      const [reply, error] = await replied.then(
        (answered) => [answered],
        (failed) => [null, failed],
      );
      // The engine goes on with what is wanted by now, while this answer is drawn.
      asked = this.#ask();
      // What is not the newest is shown, too: the picture follows.
      this.#show({ reply, error, question, take, fail });
    }
    this.#running = false;
  }

  #show = withNextFrame(({ reply, error, question, take, fail }) => {
    try {
      if (error) throw error;
      take(reply, question);
    } catch (caught) {
      if (!this.#engine.isBusy) fail(caught);
    }
  });

  /** Asks what is wanted now, if anything is. */
  #ask() {
    if (!this.#next) return null;
    const { make, take, fail } = this.#next;
    this.#next = null;
    const { question, options } = make();
    this.#begun = performance.now();
    const replied = this.#engine.ask(question, options);
    return { question, take, fail, replied };
  }
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
