// Builds the page and serves it on this machine:
//
//     node web/tools/serve.js [PORT]

import { execFileSync } from "node:child_process";
import { createReadStream, existsSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, normalize, resolve, sep } from "node:path";
import { pipeline } from "node:stream";
import { fileURLToPath } from "node:url";
import { page, web } from "./places.js";

const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".wasm": "application/wasm",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".png": "image/png",
  ".txt": "text/plain; charset=utf-8",
  ".webmanifest": "application/manifest+json",
};

/** Endings of the files that the build compressed, by the name of their coding; the better one first. */
const CODINGS = { br: ".br", gzip: ".gz" };

/** The file of a folder that a request names; `null` if there is none. */
function fileOf(folder, url) {
  let name;
  try {
    name = decodeURIComponent(new URL(url, "http://localhost").pathname);
  } catch {
    return null;
  }
  if (name.includes("\0")) return null;
  let file = resolve(folder, `.${normalize(name)}`);
  if (statSync(file, { throwIfNoEntry: false })?.isDirectory()) file = resolve(file, "index.html");
  return file.startsWith(folder + sep) && statSync(file, { throwIfNoEntry: false })?.isFile() ? file : null;
}

function answer(folder, request, response) {
  const file = fileOf(folder, request.url);
  if (!file) {
    response.writeHead(404).end();
    return;
  }
  const accepted = (request.headers["accept-encoding"] ?? "").split(",").map((coding) => coding.trim());
  const coding = Object.keys(CODINGS).find((name) => accepted.includes(name) && existsSync(file + CODINGS[name]));
  const sent = coding ? file + CODINGS[coding] : file;
  const { size, mtimeMs } = statSync(sent);
  // What the browser has is not sent again, neither to the page nor to what keeps it for use without a network.
  const etag = `"${size.toString(36)}-${Math.round(mtimeMs).toString(36)}"`;
  const isKnown = (request.headers["if-none-match"] ?? "").split(/,\s*/).includes(etag);
  response.writeHead(isKnown ? 304 : 200, {
    "content-type": TYPES[extname(file)] ?? "application/octet-stream",
    ...(coding && { "content-encoding": coding }),
    vary: "accept-encoding",
    "cache-control": "no-cache",
    etag,
    "x-content-type-options": "nosniff",
  });
  if (isKnown) response.end();
  else pipeline(createReadStream(sent), response, () => {});
}

/** Serves a folder on this machine alone; the server once it listens. */
export function serve(folder, port = 0) {
  const server = createServer((request, response) => {
    try {
      answer(folder, request, response);
    } catch {
      // A name that no file can have, such as one that is too long.
      if (!response.headersSent) response.writeHead(404);
      response.end();
    }
  });
  return new Promise((done) => server.listen(port, "127.0.0.1", () => done(server)));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  execFileSync(process.execPath, [resolve(web, "tools/build.js")], { stdio: "inherit" });
  const server = await serve(page, Number(process.argv[2] ?? 8000));
  process.stdout.write(`http://localhost:${server.address().port}/  (Ctrl-C ends it)\n`);
}
