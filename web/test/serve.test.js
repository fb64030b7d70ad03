// The server of the page: files, compressed where that is possible, and nothing that ends it.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { serve } from "../tools/serve.js";

const folder = mkdtempSync(join(tmpdir(), "slideway-page-"));
let server;

before(async () => {
  writeFileSync(join(folder, "index.html"), "the page");
  writeFileSync(join(folder, "engine.wasm"), "the engine");
  writeFileSync(join(folder, "engine.wasm.gz"), gzipSync("the engine"));
  writeFileSync(join(folder, "engine.wasm.br"), brotliCompressSync("the engine"));
  server = await serve(folder);
});
after(() => {
  server.close();
  rmSync(folder, { recursive: true });
});

/** Status and headers of a request whose path is sent as it is. */
const get = (path, headers = {}) =>
  new Promise((done, failed) => {
    request({ port: server.address().port, path, headers }, (response) => {
      response.resume();
      response.on("end", () => done(response));
    })
      .on("error", failed)
      .end();
  });

test("the better coding that a browser accepts is sent", async () => {
  for (const [accepted, coding] of [
    ["gzip, deflate, br", "br"],
    ["gzip", "gzip"],
    ["identity", undefined],
  ]) {
    const { statusCode, headers } = await get("/engine.wasm", { "accept-encoding": accepted });
    assert.equal(statusCode, 200);
    assert.equal(headers["content-encoding"], coding);
    assert.equal(headers["content-type"], "application/wasm");
  }
});

test("what a browser has is not sent again", async () => {
  const accepted = { "accept-encoding": "br" };
  const { headers } = await get("/engine.wasm", accepted);
  const again = await get("/engine.wasm", { ...accepted, "if-none-match": headers.etag });
  assert.equal(again.statusCode, 304);
  const other = await get("/engine.wasm", { "if-none-match": headers.etag });
  assert.equal(other.statusCode, 200);
});

test("no request ends it, and none leaves the folder", async () => {
  for (const path of [
    "/%E0%A4%A",
    "/%00",
    "/%",
    "//",
    "/../../etc/passwd",
    "/%2e%2e/%2e%2e/etc/passwd",
    `/${"a".repeat(5000)}`,
    "/a%2fb",
    "/engine.wasm/x",
  ]) {
    const { statusCode } = await get(path);
    assert.ok(statusCode === 404 || path === "//", `${path}: ${statusCode}`);
  }
  assert.equal((await get("/")).statusCode, 200);
});
