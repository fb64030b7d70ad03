// The engine as a function: a question in, its answer out. Runs in a worker, and in Node for tests.

const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** What became of an engine that can answer no more. */
export class Broken extends Error {}

/**
 * Starts the engine of a compiled module.
 *
 * @param {WebAssembly.Module} module
 * @param {(done: number, fraction: number | null, counted: string) => boolean} progress
 *   Learns of the progress of a question; the work ends where it returns true.
 * @returns {Promise<(question: object) => object>}
 */
export async function start(module, progress = () => false) {
  let message = "";
  const text = (place, length) => decoder.decode(new Uint8Array(exports.memory.buffer, place, length));
  const host = {
    progress: (done, fraction, place, length) =>
      progress(done, fraction < 0 ? null : fraction, text(place, length)) ? 1 : 0,
    panicked: (place, length) => {
      message = text(place, length);
    },
  };
  const { exports } = await WebAssembly.instantiate(module, { host });
  return (question) => {
    const bytes = encoder.encode(JSON.stringify(question));
    try {
      // The memory may grow, and its buffer is another one then.
      const place = exports.buffer(bytes.length);
      new Uint8Array(exports.memory.buffer, place, bytes.length).set(bytes);
      const length = exports.ask();
      return JSON.parse(text(exports.place(), length));
    } catch (error) {
      throw new Broken(message || String(error));
    }
  };
}
