// Where things are.

import { existsSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const web = resolve(dirname(fileURLToPath(import.meta.url)), "..");
export const top = resolve(web, "..");
const target = resolve(process.env.CARGO_TARGET_DIR ?? resolve(top, "target"));
/** Where Cargo builds the engine: apart from everything else, so that neither waits for the other. */
export const engineTarget = resolve(target, "web-engine");
/** The engine. */
export const engine =
  process.env.SLIDEWAY_ENGINE ?? resolve(engineTarget, "wasm32-unknown-unknown/web/slideway_web.wasm");
/** The page, ready to be served. */
export const page = resolve(target, "web");

/** The program of the command line, with which answers are compared. */
export function program() {
  const built = ["debug", "quick", "release"].map((profile) => resolve(target, profile, "slideway"));
  return process.env.SLIDEWAY ?? built.find(existsSync) ?? built[0];
}
