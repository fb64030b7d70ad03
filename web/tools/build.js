// Builds the page: the engine by Cargo, the scripts by esbuild, everything into target/web.
//
//     node web/tools/build.js            with the packages of package-lock.json, which npm installs if they are not there
//     node web/tools/build.js --engine   the engine alone
//     node web/tools/build.js --into docs/book/page   also there, beside a book with live figures
// Exit code 3: something is missing on this machine, and said.
//
// The engine needs a standard library of Rust for WebAssembly: that of `rustup target add wasm32-unknown-unknown`, or, on
// Debian, `apt-get install rustc-web rust-web-src lld-22`, from whose sources Cargo builds it.

import { execFileSync, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { start } from "../src/engine.js";
import { key } from "../src/sliders.js";
import { State } from "../src/state.js";
import { limitsQuestion, stripOf } from "../src/strip.js";
import { engine, engineTarget, page, top, web } from "./places.js";

const TARGET = "wasm32-unknown-unknown";
/** The largest that the engine may be as it is sent, compressed. */
const LARGEST = 2 << 20;
/** The exit code where something is missing on this machine. */
const MISSING = 3;
class Missing extends Error {}
const say = (text) => process.stdout.write(`${text}\n`);

/** What a command prints; nothing if it cannot be run or fails. */
function heard(command, ...words) {
  const run = spawnSync(command, words, { encoding: "utf8" });
  return run.status === 0 ? run.stdout.trim() : "";
}

/** Environment and arguments with which Cargo builds for WebAssembly, or why that is impossible. */
function compiler() {
  const ours = heard("rustc", "--print", "target-libdir", "--target", TARGET);
  if (ours && existsSync(ours)) return { words: [], environment: {} };
  const debian = "/usr/bin/rustc";
  const sources = heard(debian, "--print", "sysroot");
  const linker = ["wasm-ld", "wasm-ld-22", "wasm-ld-21", "wasm-ld-20", "wasm-ld-19"].find((name) =>
    heard(name, "--version"),
  );
  if (sources && linker && existsSync(resolve(sources, "lib/rustlib/src/rust/library/std"))) {
    return {
      words: ["-Zbuild-std=std,panic_abort"],
      environment: { RUSTC: debian, RUSTC_BOOTSTRAP: "1", CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER: linker },
    };
  }
  throw new Missing(
    `Rust's standard library for ${TARGET} is missing. Either\n` +
      `    rustup target add ${TARGET}\n` +
      "or, on Debian,\n    apt-get install rustc-web rust-web-src lld-22",
  );
}

function buildEngine() {
  const { words, environment } = compiler();
  const all = [
    "build",
    "--locked",
    "--package",
    "slideway-web",
    "--profile",
    "web",
    "--target",
    TARGET,
    "--target-dir",
    engineTarget,
    ...words,
  ];
  execFileSync(process.env.CARGO ?? "cargo", all, {
    cwd: top,
    stdio: "inherit",
    env: { ...process.env, ...environment },
  });
}

/** The packages of the lock file. */
function install() {
  const wanted = readFileSync(resolve(web, "package-lock.json"), "utf8");
  const kept = resolve(web, "node_modules/.of-lock-file");
  if (existsSync(kept) && readFileSync(kept, "utf8") === wanted) return;
  if (!heard("npm", "--version"))
    throw new Missing("npm is missing, which installs the packages of web/package-lock.json");
  execFileSync("npm", ["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"], {
    cwd: web,
    stdio: "inherit",
  });
  writeFileSync(kept, wanted);
}

async function bundle() {
  const { build } = await import("esbuild");
  const { metafile } = await build({
    entryPoints: ["page.js", "worker.js", "embed.js"].map((name) => resolve(web, "src", name)),
    outdir: page,
    bundle: true,
    format: "esm",
    target: "es2022",
    minify: true,
    metafile: true,
    define: { ENGINE_BYTES: String(statSync(engine).size) },
    logLevel: "warning",
  });
  const packages = Object.keys(metafile.inputs).map((input) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(input)?.[1]);
  return [...new Set(packages.filter(Boolean))].sort();
}

/** The notices of what is part of the page: those of the program, whose libraries the engine shares, and of packages. */
function notices(packages) {
  const licence = (name) =>
    `\n${"=".repeat(72)}\n${name}\n\n${readFileSync(resolve(web, "node_modules", name, "LICENSE"), "utf8")}`;
  return readFileSync(resolve(top, "THIRD-PARTY-NOTICES"), "utf8") + packages.map(licence).join("");
}

/** What the page shows of the model to begin with until the engine has come. */
async function prepared(ask, library) {
  const state = await State.of("", library);
  const { answer: look } = ask({ ask: "look", ...state.asked(), margins: true });
  state.strip = stripOf(look.quantities);
  const varied = look.quantities.find((quantity) => key(quantity) === key(state.strip));
  const { json } = ask(limitsQuestion(state, varied)).answer;
  return { look, limits: { json } };
}

/** The rest: the engine, its style sheet, the models to begin with, and what stands beside. */
async function gather(packages) {
  cpSync(engine, resolve(page, "engine.wasm"));
  const ask = await start(await WebAssembly.compile(readFileSync(engine)));
  writeFileSync(resolve(page, "drawing.css"), ask({ ask: "style" }).answer);
  const library = ask({ ask: "library" }).answer;
  writeFileSync(resolve(page, "library.json"), JSON.stringify(library));
  writeFileSync(resolve(page, "prepared.json"), JSON.stringify(await prepared(ask, library)));
  for (const name of ["index.html", "style.css", "manifest.webmanifest", "icon.svg"])
    cpSync(resolve(web, "src", name), resolve(page, name));
  writeFileSync(resolve(page, "notices.txt"), notices(packages));
  const files = readdirSync(page).sort();
  const hash = createHash("sha256");
  for (const name of files) hash.update(readFileSync(resolve(page, name)));
  const version = `slideway-${hash.digest("hex").slice(0, 16)}`;
  const service = readFileSync(resolve(web, "src/service.js"), "utf8");
  const kept = ["./", ...files].join(" ");
  writeFileSync(resolve(page, "service.js"), service.replace("{{ version }}", version).replace("{{ files }}", kept));
}

/** The engine compressed as well as brotli can, which takes its time: kept beside it until there is another one. */
function smallestEngine(bytes) {
  const kept = resolve(engineTarget, `engine-${createHash("sha256").update(bytes).digest("hex").slice(0, 16)}.br`);
  if (existsSync(kept)) return readFileSync(kept);
  const compressed = brotliCompressSync(bytes, {
    params: {
      [constants.BROTLI_PARAM_QUALITY]: constants.BROTLI_MAX_QUALITY,
      [constants.BROTLI_PARAM_LGWIN]: constants.BROTLI_MAX_WINDOW_BITS,
      [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length,
    },
  });
  mkdirSync(engineTarget, { recursive: true });
  for (const old of readdirSync(engineTarget).filter((name) => /^engine-.*\.br$/.test(name)))
    rmSync(resolve(engineTarget, old));
  writeFileSync(kept, compressed);
  return compressed;
}

/** Compresses what is sent as text or code, each file beside itself, so that a server need not do it for every visitor. */
function compress() {
  const shown = (length) => `${(length / 1e6).toFixed(2)} MB`;
  for (const name of readdirSync(page).filter((file) => /\.(wasm|js|css|json|html|svg|txt)$/.test(file))) {
    const bytes = readFileSync(resolve(page, name));
    const gzip = gzipSync(bytes, { level: 9 });
    const brotli = name === "engine.wasm" ? smallestEngine(bytes) : brotliCompressSync(bytes);
    writeFileSync(resolve(page, `${name}.gz`), gzip);
    writeFileSync(resolve(page, `${name}.br`), brotli);
    if (["engine.wasm", "page.js"].includes(name))
      say(
        `${name}: ${shown(bytes.length)}, compressed ${shown(gzip.length)} (gzip) or ${shown(brotli.length)} (brotli)`,
      );
    if (gzip.length > LARGEST) throw new Error(`${name} has more than 2 MiB compressed`);
  }
}

try {
  if (!process.env.SLIDEWAY_ENGINE) buildEngine();
  if (!process.argv.includes("--engine")) {
    install();
    rmSync(page, { recursive: true, force: true });
    mkdirSync(page, { recursive: true });
    await gather(await bundle());
    compress();
    say(`The page is in ${page}.`);
    const into = process.argv.indexOf("--into");
    if (into > 0) cpSync(page, resolve(process.argv[into + 1]), { recursive: true });
  }
} catch (error) {
  process.stderr.write(`${error.message}\n`);
  process.exitCode = error instanceof Missing ? MISSING : 1;
}
