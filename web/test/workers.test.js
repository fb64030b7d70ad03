// Questions to engines in workers: in which order, how many at once, and what ends them.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { setImmediate as turn } from "node:timers/promises";
import { Ended, Engine, Newest } from "../src/workers.js";

const module = Promise.resolve("the module");
let workers = [];

beforeEach(() => {
  workers = [];
  // Nothing waits for frames.
  globalThis.document = { hidden: true };
  globalThis.Worker = class {
    heard = [];
    isEnded = false;
    constructor() {
      workers.push(this);
    }
    postMessage(message) {
      this.heard.push(message);
    }
    terminate() {
      this.isEnded = true;
    }
    /** The questions that it has. */
    get questions() {
      return this.heard.flatMap(({ question }) => (question === undefined ? [] : [question]));
    }
    /** Answers a question. */
    answer(question, told = { reply: { answer: question } }) {
      const { number } = this.heard.findLast((message) => message.question === question);
      this.onmessage({ data: { number, milliseconds: 1, ...told } });
    }
  };
});

/** What becomes of questions. */
function follower(newest) {
  const taken = [];
  const failed = [];
  const want = (question) =>
    newest.want(
      () => ({ question }),
      (reply) => taken.push(reply.answer),
      (error) => failed.push(error),
    );
  return { taken, failed, want };
}

test("the engine has the next question while it answers one, and of the others only the newest", async () => {
  const { taken, failed, want } = follower(new Newest(new Engine(module, "worker.js")));
  for (const question of [1, 2, 3, 4]) want(question);
  const [worker] = workers;
  assert.deepEqual(worker.questions, [1, 2]);
  worker.answer(1);
  await turn();
  assert.deepEqual(worker.questions, [1, 2, 4]);
  worker.answer(2);
  worker.answer(4);
  await turn();
  assert.deepEqual([taken, failed], [[1, 2, 4], []]);
});

test("a question that takes long is ended for the next, which is answered by another worker", async () => {
  const { taken, failed, want } = follower(new Newest(new Engine(module, "worker.js"), 20));
  want(1);
  want(2);
  want(3);
  while (workers.length < 2) await turn();
  await turn();
  assert.ok(workers[0].isEnded);
  assert.deepEqual(workers[1].questions, [2, 3]);
  workers[1].answer(2);
  workers[1].answer(3);
  await turn();
  assert.deepEqual([taken, failed], [[2, 3], []]);
});

test("where an engine breaks the next question is answered all the same", async () => {
  const engine = new Engine(module, "worker.js");
  const [one, other] = [engine.ask("one"), engine.ask("other")];
  workers[0].answer("one", { broken: "out of memory" });
  await assert.rejects(one, /the engine stopped: out of memory/);
  await turn();
  assert.deepEqual(workers[1].questions, ["other"]);
  workers[1].answer("other");
  assert.equal((await other).answer, "other");
  assert.ok(!engine.isBusy);
});

test("once all questions are ended the newest is asked, and answered", async () => {
  const engine = new Engine(module, "worker.js");
  const { taken, failed, want } = follower(new Newest(engine));
  for (const question of [1, 2, 3]) want(question);
  engine.cancel();
  await turn();
  assert.deepEqual(workers[1].questions, [3]);
  workers[1].answer(3);
  await turn();
  assert.deepEqual([taken, failed], [[3], []]);
  want(4);
  engine.cancel();
  await turn();
  assert.ok(failed[0] instanceof Ended);
});
