// The state of the page: the model, what is changed in it, and what is looked at; and its address.

/** Without a change for this long (ms) what takes longer is computed, too. */
export const REST = 250;

/** What a setting is on the command line. */
const OPTIONS = { parameter: "--set", position: "--at", rate: "--rate" };
const KEYS = { parameter: "set", position: "at", rate: "rate" };

export class State {
  /** The text of the model file. */
  text = "";
  /** The name of the model to begin with, such as "gallery:drawer"; empty once its text is changed. */
  from = "";
  /** What is changed: texts of values by "kind name". */
  changes = new Map();
  /** What the strip varies: { kind, name, from, to } in the unit of the quantity, or null. */
  strip = null;
  /** What the map varies, likewise: { x, y, colours }, or null. */
  map = null;
  /** Until when the motion goes. */
  until = "";
  /** Which tab is open. */
  tab = "numbers";
  /** What of the address could not be read, in sentences. */
  unread = [];

  /** Settings of a question; without those of some quantities. */
  settings(...without) {
    const left = without.map(({ kind, name }) => `${kind} ${name}`);
    return [...this.changes]
      .filter(([key]) => !left.includes(key))
      .map(([key, value]) => {
        const [kind, ...name] = key.split(" ");
        return { kind, name: name.join(" "), value };
      });
  }

  /** What is asked about, for a question. */
  asked(...without) {
    return { text: this.text, settings: this.settings(...without) };
  }

  /** The name of the model's file. */
  get file() {
    const name = this.from.split(":")[1] || "model";
    return `${name}.toml`;
  }

  /** The command that gives the same. */
  command(verb = "solve", ...more) {
    const words = this.settings().flatMap(({ kind, name, value }) => [OPTIONS[kind], quoted(`${name}=${value}`)]);
    return ["slideway", verb, this.file, ...words, ...more].join(" ");
  }

  /** The part of the address behind "#"; empty for a model that is too large for one. */
  async address() {
    const parts = new URLSearchParams();
    if (this.from) parts.set("model", this.from);
    else parts.set("text", await packed(this.text));
    if (parts.get("text")?.length > LONGEST) return "";
    for (const { kind, name, value } of this.settings()) parts.append(KEYS[kind], `${name}=${value}`);
    if (this.strip) parts.set("vary", written(this.strip));
    if (this.map) {
      parts.set("x", written(this.map.x));
      parts.set("y", written(this.map.y));
      parts.set("colours", this.map.colours);
    }
    if (this.until) parts.set("until", this.until);
    if (this.tab !== "numbers") parts.set("tab", this.tab);
    return parts.toString();
  }

  /** The state of an address; `library` are the models to begin with. */
  static async of(address, library) {
    const state = new State();
    const parts = new URLSearchParams(address);
    const known = (name) => library.find((entry) => `${entry.kind}:${entry.name}` === name);
    const text = parts.get("text");
    if (text) {
      state.text = await unpacked(text);
    } else {
      const wanted = parts.get("model");
      const entry = known(wanted) ?? known("gallery:drawer");
      if (wanted && !known(wanted)) state.unread.push(`There is no model ${wanted}: this is the drawer.`);
      state.from = `${entry.kind}:${entry.name}`;
      state.text = entry.text;
    }
    for (const [kind, key] of Object.entries(KEYS)) {
      for (const setting of parts.getAll(key)) {
        const [name, ...value] = setting.split("=");
        state.changes.set(`${kind} ${name}`, value.join("="));
      }
    }
    const range = (part) => {
      const found = read(parts.get(part));
      if (parts.get(part) && !found) state.unread.push(`The range ${parts.get(part)} of the address cannot be read.`);
      return found;
    };
    state.strip = range("vary");
    const [x, y] = [range("x"), range("y")];
    if (x && y) state.map = { x, y, colours: parts.get("colours") ?? "solutions" };
    state.until = parts.get("until") ?? "";
    state.tab = parts.get("tab") ?? "numbers";
    return state;
  }
}

/** What settings change: texts of values by "kind name". */
export const changesOf = (settings) => new Map(settings.map(({ kind, name, value }) => [`${kind} ${name}`, value]));

const written = ({ kind, name, from, to }) => [kind, name, from, to].join("~");

function read(text) {
  const [kind, name, from, to] = (text ?? "").split("~");
  const ends = [from, to].map(Number);
  return name && ends.every(Number.isFinite) && ends[0] < ends[1] ? { kind, name, from: ends[0], to: ends[1] } : null;
}

/** A word of a command line. */
export function quoted(word) {
  return /^[\w.,:=+/-]+$/.test(word) ? word : `"${word.replace(/["\\$`]/g, "\\$&")}"`;
}

/** The longest text in an address, packed: what browsers, mails and chats let through. */
const LONGEST = 60_000;
/** The largest text that is unpacked: as large as a model may be, and a little more, so that it is refused as too large. */
const LARGEST = (4 << 20) + 1;

async function packed(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  let binary = "";
  for (let start = 0; start < bytes.length; start += 0x8000)
    binary += String.fromCharCode(...bytes.subarray(start, start + 0x8000));
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

async function unpacked(text) {
  try {
    const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
    const decoder = new TextDecoder();
    let whole = "";
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return whole + decoder.decode();
      whole += decoder.decode(value, { stream: true });
      if (whole.length > LARGEST) {
        await reader.cancel();
        return whole;
      }
    }
  } catch {
    return "# The address does not hold a whole model.\n";
  }
}
