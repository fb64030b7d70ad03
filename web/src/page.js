// The page: a model, what is changed in it, and what the engine says of it.

import { byId, element, inWords, parsed, say, settled, themeName, withNextFrame } from "./dom.js";
import { pixels, save } from "./downloads.js";
import { Drawings, grown, widest } from "./drawings.js";
import { Editor } from "./editor.js";
import { MapPanel } from "./map.js";
import { MotionPanel } from "./motion.js";
import { withUnit } from "./numbers.js";
import { Sliders, key } from "./sliders.js";
import { REST, State, changesOf } from "./state.js";
import { Strip, along, eligibleOf, limitsQuestion, stripOf } from "./strip.js";
import { Verdict } from "./verdict.js";
import { Engine, Newest, Turns, load } from "./workers.js";

/** A file larger than this is not read: no model is. */
const LARGEST_FILE = 4 << 20;

byId("loading").max = ENGINE_BYTES;
/** The models to begin with. */
const library = fetch("library.json").then((response) => response.json());
/** What the engine said of the first of them when the page was built: shown until it is here itself. */
const prepared =
  location.hash.length > 1
    ? Promise.resolve(null)
    : fetch("prepared.json")
        .then((response) => response.json())
        .catch(() => null);
/** The engine, which takes all of a slow line. */
const module = Promise.allSettled([library, prepared]).then(() =>
  load("engine.wasm", (bytes) => {
    byId("loading").value = bytes;
  }),
);
let isHere = false;
module
  .catch(() => {})
  .finally(() => {
    isHere = true;
    byId("loading").hidden = true;
    wait(false);
  });
/** One engine follows what is dragged, the other answers what takes longer. */
const live = new Engine(module, "worker.js");
const slow = new Turns(new Engine(module, "worker.js"));
const newest = new Newest(live);
live.begin();

let state = new State();
/** What the engine said last, of which text and settings. */
let look = null;
/** What drawings keep while values change: { held, text }, the engine's own words for scale and place, and for which model. */
let kept = { held: null, text: "" };
/** How wide drawings may be. */
let most = widest();

const verdict = new Verdict(document, () => {
  live.cancel();
  slow.end();
});
const drawings = new Drawings(byId("drawings"));
const sliders = new Sliders(byId("sliders"), changed);
const editor = new Editor(byId("editor"), settled(edited, 120));
const strip = new Strip(
  byId("strip"),
  (value) => changed(varied(), withUnit(value, varied().unit)),
  (words) => verdict.near(words),
);
const map = new MapPanel(byId("panel-map"), {
  ask: (question, axes) => slowly({ ...question, ...state.asked(...axes) }),
  move: (moves) => changedAll(moves.map(([quantity, value]) => [quantity, withUnit(value, quantity.unit)])),
  wanted: (wanted) => {
    state.map = wanted;
    remember();
  },
});
const motion = new MotionPanel(byId("panel-motion"), (until) => {
  state.until = until;
  remember();
  return slowly({ ask: "simulate", ...state.asked(), until, frames: true });
});

// ---- What is asked

/** Shows the present state, and all that follows from it. */
function refresh() {
  // What was asked of another model is not shown any more.
  const asking = state;
  const ifSame =
    (act) =>
    (...given) => {
      if (asking === state) act(...given);
    };
  told("asking");
  const wanted = (margins) =>
    newest.want(
      () => ({
        question: { ask: "look", ...state.asked(), margins, held: kept.text === state.text ? kept.held : null, most },
        options: { seconds: 10, progress: (done) => verdict.progress(done) },
      }),
      ifSame(took),
      ifSame(failed),
    );
  wanted(false);
  thoroughly(wanted);
  showChanges();
  remember();
}

/** Shows that something is changed, and the command that does so. */
const showChanges = withNextFrame(() => {
  say(byId("command"), state.command());
  byId("reset").hidden = state.changes.size === 0;
});

const thoroughly = settled((wanted) => {
  wanted(true);
  motion.clear();
}, REST);

/** The reply of a look. */
function took(reply, question) {
  verdict.rest();
  document.documentElement.dataset.milliseconds = reply.milliseconds.toFixed(1);
  if (question.margins && state.tab === "rest") showRest();
  const isFirst = !look;
  if (isFirst) {
    sliders.clear();
    verdict.forget();
  }
  // More is known of this state than this answer says.
  if (!isFirst && !question.margins && thorough === questioned(question)) {
    told("shown", question);
    return;
  }
  if (reply.faults) {
    if (isFirst) showNothing();
    thorough = "";
    showFaults(reply.faults, question);
    told("faults", question);
    return;
  }
  showLook(reply.answer, question, isFirst);
  told("shown", question);
  document.documentElement.dataset.shown = String(Number(document.documentElement.dataset.shown ?? 0) + 1);
  keep();
}

const questioned = ({ text, settings }) => JSON.stringify([text, settings]);

/** The question whose answer is shown, if that has margins of friction. */
let thorough = "";

/** Shows an answer of the engine. */
function showLook(answer, question, isFirst) {
  const asked = changesOf(question.settings);
  thorough = question.margins ? questioned(question) : "";
  look = answer;
  if (look.answer && question.most === most)
    kept = { held: grown(kept.text === question.text ? kept.held : null, look.held), text: question.text };
  showFaults(look.warnings, question);
  verdict.show(look);
  const title = `${look.title} – slideway`;
  if (document.title !== title) document.title = title;
  say(byId("about"), look.title);
  drawings.show(look.drawings);
  sliders.show(look.quantities, state.changes, asked);
  byId("left-out").hidden = !look.left_out;
  say(byId("left-out"), `${look.left_out} more parameters can be changed in the text.`);
  map.show(look.quantities, state.map);
  showNumbers(isFirst || question.margins);
  showStrip(asked);
}

/** Shows what was prepared, while the engine is on its way. */
async function showPrepared() {
  const asking = state;
  const known = await prepared;
  if (!known || asking !== state || look) return;
  const { look: answer, limits } = known;
  showLook(answer, { ...state.asked(), margins: true, most: null }, true);
  strip.took({ answer: limits });
  wait(!isHere);
  told("prepared");
}

/** What is dragged waits for the engine. */
function wait(isWaiting) {
  for (const id of ["strip-section", "values"]) byId(id).inert = isWaiting;
  if (varied()) say(byId("invitation"), invitation(varied()));
}

/** The sections that are shown. */
let numbers = "";

/** The numbers, at once or when values rest: until then those that are there are of a state before, and grey. */
function showNumbers(atOnce) {
  const wanted = look.answer?.sections.join("") ?? "";
  const panel = byId("panel-numbers");
  panel.classList.toggle("stale", !atOnce && wanted !== numbers);
  if (wanted === numbers) return;
  if (!atOnce) return showNumbersAtRest();
  numbers = wanted;
  panel.replaceChildren(...parsed(wanted));
  // Where tables are wider than the screen the keyboard moves them, too.
  for (const wide of panel.querySelectorAll(".wide")) wide.tabIndex = 0;
}

const showNumbersAtRest = settled(() => look && showNumbers(true), REST);

/** There is nothing to show of a model whose file is at fault from the beginning. */
function showNothing() {
  document.title = "slideway";
  byId("about").textContent = "";
  drawings.show([]);
  byId("panel-numbers").replaceChildren();
  numbers = "";
  byId("left-out").hidden = true;
}

let isKept = false;

/** Keeps the page for use without a network, once it shows something: before that the network has better to do. */
function keep() {
  if (isKept || !("serviceWorker" in navigator) || location.protocol === "file:") return;
  isKept = true;
  navigator.serviceWorker.register("service.js").catch(() => {});
}

/** What has become of the present text and settings, for tests; `question`: the one that this answers. */
function told(what, question = state.asked()) {
  if (questioned(question) === questioned(state.asked())) document.documentElement.dataset.state = what;
}

function failed(error) {
  verdict.fail(error);
  byId("drawings").classList.add("stale");
  told("failed");
}

/** What did not work, beside the answer, until there is another model. */
function notice(text) {
  byId("notice").textContent = text;
  byId("notice").hidden = text === "";
}

/** The faults that are listed, and of which text. */
let faultsListed = "";

/** Faults are told below the editor and underlined in it; while there are any the drawing is of the state before. */
function showFaults(faults, question) {
  const errors = faults.filter(({ is_warning }) => !is_warning);
  byId("drawings").classList.toggle("stale", errors.length > 0);
  if (errors.length > 0) {
    verdict.showFaults(errors, (fault) => listed(fault, fault.message, question.text));
  }
  sliders.showFaults(errors, question.settings, state.changes);
  editor.showFaults(faults, question.text);
  const all = JSON.stringify([faults, question.text]);
  if (all === faultsListed) return;
  faultsListed = all;
  byId("faults").replaceChildren(
    ...faults.slice(0, 50).map((fault) => {
      const line = listed(fault, [fault.message, fault.hint].filter(Boolean).join(" – "), question.text);
      line.className = fault.is_warning ? "warning" : "error";
      return line;
    }),
  );
}

/** A fault in a list: a button that goes to its place, if that is in the text. */
const listed = ({ place }, words, text) =>
  element(
    "li",
    {},
    place?.text === "model"
      ? element(
          "button",
          { type: "button", class: "link", onclick: () => editor.goTo(place) },
          `${lineOf(text, place.from)}: ${words}`,
        )
      : words,
  );

const lineOf = (text, place) => `line ${text.slice(0, place).split("\n").length}`;

/** The reply of the engine for what takes longer, with its progress. */
async function slowly(question) {
  try {
    return await slow.ask(question.ask, question, { seconds: 60, progress: (done) => verdict.progress(done) });
  } finally {
    verdict.rest();
  }
}

// ---- What is changed

// A phone that is turned has another width: drawings begin anew.
addEventListener("resize", () => {
  if (most === widest()) return;
  most = widest();
  kept = { held: null, text: "" };
  refresh();
});

/** A value was typed or dragged. */
function changed(quantity, text) {
  changedAll([[quantity, text]]);
}

function changedAll(changes) {
  for (const [quantity, text] of changes) {
    if (text === null) state.changes.delete(key(quantity));
    else state.changes.set(key(quantity), text);
  }
  refresh();
}

function edited(text) {
  state.text = text;
  state.from = "";
  byId("pick").value = "";
  refresh();
}

/** Begins with another state. */
function begin(next) {
  state = next;
  look = null;
  kept = { held: null, text: "" };
  if (!isHere) {
    verdict.begin();
    byId("drawings").classList.add("stale");
  }
  document.documentElement.dataset.begun = String(Number(document.documentElement.dataset.begun ?? 0) + 1);
  notice(state.unread.join(" "));
  limitsOf = "";
  strip.forget();
  editor.text = state.text;
  byId("pick").value = state.from;
  motion.until = state.until;
  openTab(state.tab);
  refresh();
}

let awaited = 0;

/** Begins with another state once it is there, unless another one is asked for meanwhile. */
async function beginOnce(coming) {
  awaited += 1;
  const own = awaited;
  const next = await coming;
  if (own === awaited) begin(next);
}

/** The state of what a link or a choice of a model says. */
const stateOf = async (said) => State.of(said, await library);

async function stateWith(file) {
  const next = new State();
  next.text = await file.text();
  next.tab = state.tab;
  return next;
}

byId("reset").addEventListener("click", () => {
  state.changes.clear();
  kept = { held: null, text: "" };
  refresh();
});

/** Offers the models to begin with. */
function offerModels(entries) {
  for (const [kind, title] of [
    ["gallery", "Gallery"],
    ["template", "Templates"],
  ]) {
    const options = entries
      .filter((entry) => entry.kind === kind)
      .map((entry) => element("option", { value: `${kind}:${entry.name}`, title: entry.shows }, entry.summary));
    byId("pick").append(element("optgroup", { label: title }, ...options));
  }
  byId("pick").prepend(element("option", { value: "", disabled: true }, "a text of one's own"));
}

byId("pick").addEventListener("change", () =>
  beginOnce(stateOf(new URLSearchParams({ model: byId("pick").value }))),
);

byId("open").addEventListener("click", () => byId("file").click());
byId("file").addEventListener("change", () => openFile(byId("file").files[0]));
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  openFile(event.dataTransfer.files[0]);
});

function openFile(file) {
  if (!file) return;
  if (file.size > LARGEST_FILE) notice(`${file.name} is larger than 4 MiB, too large for a model.`);
  else beginOnce(stateWith(file));
}

// ---- The strip

const choice = element("select", { id: "vary" });
const ends = [0, 1].map((index) =>
  element("input", { type: "text", class: "field", inputmode: "decimal", "aria-label": index ? "to" : "from" }),
);
const endUnit = element("span", { class: "unit" });
byId("strip").before(
  element(
    "p",
    { class: "controls" },
    element("label", {}, "over ", choice),
    element("label", {}, " from ", ends[0]),
    element("label", {}, " to ", ends[1]),
    " ",
    endUnit,
  ),
);
let limitsOf = "";

/** The quantity along the strip. */
const varied = () => look?.quantities.find((quantity) => state.strip && key(quantity) === key(state.strip));

/** `asked`: what was changed when it was asked for what is shown. */
function showStrip(asked = state.changes) {
  const eligible = eligibleOf(look.quantities);
  const names = eligible.map(key);
  if (JSON.stringify(names) !== choice.dataset.names) {
    choice.replaceChildren(...eligible.map((quantity) => element("option", { value: key(quantity) }, quantity.name)));
    choice.dataset.names = JSON.stringify(names);
  }
  if (!varied()) state.strip = stripOf(look.quantities);
  if (!state.strip) return;
  const quantity = varied();
  say(byId("invitation"), invitation(quantity));
  if (choice.value !== key(quantity)) choice.value = key(quantity);
  say(endUnit, quantity.unit);
  [state.strip.from, state.strip.to].forEach((value, index) => {
    if (document.activeElement !== ends[index] && ends[index].value !== String(value)) ends[index].value = value;
  });
  strip.prepare(state.strip, quantity, asked.get(key(quantity)) === state.changes.get(key(quantity)));
  askLimits();
}

/** The question that the strip answers, and what to do. */
function invitation({ kind, name, meaning, is_friction }) {
  const asks = look.is_at_rest ? "Does it hold?" : "Does it jam?";
  const what = [is_friction ? "the friction" : kind === "position" ? "the position" : "", name].filter(Boolean).join(" ");
  const means = kind === "parameter" && meaning ? ` (${meaning})` : "";
  return `${is_friction ? asks : "What changes?"} ${isHere ? "Drag" : "In a moment, drag"} ${what}${means}.`;
}

/** Asks where each mode exists, unless that is known: it does not depend on the value that is varied. */
const askLimits = settled(async () => {
  const quantity = varied();
  if (!quantity) return;
  const question = limitsQuestion(state, quantity);
  const asked = JSON.stringify(question);
  if (asked === limitsOf) return;
  limitsOf = asked;
  try {
    const reply = await slowly(question);
    if (limitsOf !== asked) return;
    strip.took(reply);
    document.documentElement.dataset.limits = asked;
  } catch (error) {
    if (limitsOf === asked) {
      limitsOf = "";
      strip.refuse(`Not known: ${error.message}.`);
    }
  }
}, 60);

choice.addEventListener("change", () => {
  state.strip = along(look.quantities.find((quantity) => key(quantity) === choice.value));
  showStrip();
  remember();
});
ends.forEach((field, index) =>
  field.addEventListener("change", () => {
    const value = Number(field.value);
    const next = { ...state.strip, [index ? "to" : "from"]: value };
    if (field.value.trim() !== "" && next.from < next.to) state.strip = next;
    field.value = index ? state.strip.to : state.strip.from;
    showStrip();
    remember();
  }),
);

// ---- Tabs

const tabs = [...byId("tabs").children];
const nameOf = (tab) => tab.id.slice("tab-".length);

function openTab(name) {
  const open = tabs.find((tab) => nameOf(tab) === name) ?? tabs[0];
  state.tab = nameOf(open);
  for (const tab of tabs) {
    tab.setAttribute("aria-selected", String(tab === open));
    tab.tabIndex = tab === open ? 0 : -1;
    byId(tab.getAttribute("aria-controls")).hidden = tab !== open;
  }
  if (state.tab === "rest") showRest();
}

for (const tab of tabs) {
  tab.addEventListener("click", () => {
    openTab(nameOf(tab));
    remember();
  });
  tab.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    const next = tabs[(tabs.indexOf(tab) + step + tabs.length) % tabs.length];
    next.focus();
    next.click();
  });
}

/** Whether it stays at rest, and which efforts its drives need. */
const showRest = settled(async () => {
  if (!look) return;
  const panel = byId("panel-rest");
  const questions = [["At rest", "hold"], ...(look.drives.length > 0 ? [["Efforts and efficiency", "drive"]] : [])];
  const told = [];
  for (const [title, ask] of questions) {
    try {
      const reply = await slowly({ ask, ...state.asked() });
      const text = reply.faults ? reply.faults.map(inWords).join("\n") : reply.answer.text;
      told.push(element("h3", {}, title), element("pre", { tabindex: "0" }, text));
    } catch (error) {
      told.push(element("p", {}, error.message));
    }
  }
  panel.replaceChildren(...told);
}, 50);

// ---- Address, downloads, colours

let address = "";

const remember = settled(async () => {
  address = await state.address();
  history.replaceState(null, "", `#${address}`);
}, 100);

addEventListener("hashchange", () => {
  const wanted = location.hash.slice(1);
  if (wanted !== address) beginOnce(stateOf(wanted));
});

byId("share").addEventListener("click", async () => {
  address = await state.address();
  if (!address) return notice("This model is too large for a link: send its file.");
  history.replaceState(null, "", `#${address}`);
  await copy(location.href, byId("share"), "Copied");
});

async function copy(text, button, done) {
  button.dataset.name ??= button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = done;
  } catch {
    button.textContent = "Not allowed here";
  }
  setTimeout(() => {
    button.textContent = button.dataset.name;
  }, 1500);
}

const offers = {
  toml: async (name) => save(await written(), `${name}.toml`, "application/toml"),
  svg: async (name) => save(await drawn(), `${name}.svg`, "image/svg+xml"),
  png: async (name) => save(await pixels(await drawn()), `${name}.png`, "image/png"),
  csv: async (name) => save((await answered({ ask: "solve" })).csv, `${name}.csv`, "text/csv"),
  json: async (name) => save((await answered({ ask: "solve" })).json, `${name}.json`, "application/json"),
  motion: async (name) =>
    save(
      (await answered({ ask: "simulate", until: state.until || "2 s", table: true })).csv,
      `${name}-motion.csv`,
      "text/csv",
    ),
  command: (_, button) => copy(state.command(), button, "Copied"),
};

async function answered(question) {
  const reply = await slowly({ ...question, ...state.asked() });
  if (reply.faults) throw new Error(reply.faults[0].message);
  return reply.answer;
}

/** The text of the model with what is changed; as it is where nothing is, even if it is at fault. */
const written = async () => (state.changes.size === 0 ? state.text : await answered({ ask: "save" }));

const drawn = async () => (await answered({ ask: "draw", theme: themeName() })).svg;

byId("downloads").addEventListener("click", async ({ target }) => {
  const offer = offers[target.dataset.file];
  if (!offer) return;
  try {
    await offer(state.file.replace(/\.toml$/, ""), target);
  } catch (error) {
    notice(error.message);
  }
});

// Escape and a press elsewhere close a menu.
addEventListener("keydown", ({ key: pressed }) => {
  const open = pressed === "Escape" && document.querySelector(".menu[open]");
  if (!open) return;
  open.open = false;
  open.querySelector("summary").focus();
});
addEventListener("pointerdown", ({ target }) => {
  for (const menu of document.querySelectorAll(".menu[open]")) if (!menu.contains(target)) menu.open = false;
});

const theme = byId("theme");
theme.value = localStorage.getItem("theme") ?? "";
const paint = () => {
  if (theme.value) document.documentElement.dataset.theme = theme.value;
  else delete document.documentElement.dataset.theme;
};
theme.addEventListener("change", () => {
  localStorage.setItem("theme", theme.value);
  paint();
});
paint();

try {
  offerModels(await library);
  await beginOnce(stateOf(location.hash.slice(1)));
  await showPrepared();
} catch (error) {
  failed(error);
}
