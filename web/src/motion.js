// The motion in time: its moving picture, and its story.

import { element, inWords, shape, shapes } from "./dom.js";

export class MotionPanel {
  #ask;
  #until = element("input", { type: "text", class: "field", value: "2 s", autocomplete: "off" });
  #notice = element("p", { class: "quiet", role: "status" });
  #stage = shape("svg", { role: "img" });
  #play = element("button", { type: "button", class: "play" }, "Play");
  #time = element("input", { type: "range", min: 0, value: 0, "aria-label": "time" });
  #clock = element("output", { class: "clock" });
  #words = element("p", { class: "words" });
  #log = element("ol", { class: "log" });
  #player = element("div", { class: "player", hidden: true });
  #film = null;
  #parts = [];
  #frame = 0;
  #started = null;

  /** `ask(until)` gives the reply; `wanted(until)` learns what is asked for. */
  constructor(place, ask) {
    this.#ask = ask;
    const begin = element("button", { type: "submit" }, "Follow the motion");
    const form = element(
      "form",
      {
        class: "controls",
        onsubmit: (event) => {
          event.preventDefault();
          this.follow();
        },
      },
      element("label", {}, "until ", this.#until),
      begin,
    );
    const step = (by) => () => this.#rest(Math.min(this.#film.frames.length - 1, Math.max(0, this.#frame + by)));
    const controls = element(
      "p",
      { class: "controls" },
      this.#play,
      element("button", { type: "button", "aria-label": "one frame back", onclick: step(-1) }, "◀"),
      element("button", { type: "button", "aria-label": "one frame on", onclick: step(1) }, "▶"),
      this.#time,
      this.#clock,
    );
    this.#player.append(this.#stage, controls, this.#words, this.#log);
    place.append(form, this.#notice, this.#player);
    this.#time.addEventListener("input", () => this.#rest(Number(this.#time.value)));
    this.#play.addEventListener("click", () => (this.#started === null ? this.#start() : this.#rest(this.#frame)));
  }

  set until(text) {
    if (text) this.#until.value = text;
  }

  /** What was shown is of another state. */
  clear() {
    if (!this.#film) return;
    this.#film = null;
    this.#started = null;
    this.#player.hidden = true;
    this.#notice.textContent = "The model has changed: follow its motion anew.";
  }

  /** Asks for the motion. */
  async follow() {
    this.#notice.textContent = "Following the motion …";
    this.#player.hidden = true;
    try {
      const reply = await this.#ask(this.#until.value);
      if (reply.faults) {
        this.#notice.textContent = reply.faults.map(inWords).join("; ");
        return;
      }
      this.#show(JSON.parse(reply.answer.film), JSON.parse(reply.answer.json));
    } catch (error) {
      this.#notice.textContent = error.message;
    }
  }

  #show(film, report) {
    this.#film = film;
    this.#parts = film.shapes.map((markup) => shapes(markup));
    const exaggerated = film.is_exaggerated ? " The play in the guides is exaggerated." : "";
    const circles = film.friction_circles ? ` ${film.friction_circles}` : "";
    this.#notice.textContent = `${report.end?.words ?? ""} ${film.speed}.${exaggerated}${circles}`.trim();
    this.#stage.setAttribute("viewBox", film.view_box);
    this.#time.max = film.frames.length - 1;
    this.#log.replaceChildren(
      ...film.events.map(([time, words]) => {
        const go = () =>
          this.#rest(
            Math.max(
              0,
              film.frames.findIndex((frame) => frame.time >= time),
            ),
          );
        return element("li", {}, element("button", { type: "button", onclick: go }, `${time.toFixed(4)} s  ${words}`));
      }),
    );
    this.#player.hidden = false;
    this.#paint(0);
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.#start();
  }

  #paint(index) {
    const { frames, words, events, force_scale } = this.#film;
    const frame = frames[index];
    this.#frame = index;
    this.#stage.replaceChildren(
      ...frame.shapes.flatMap((part) => this.#parts[part].map((node) => node.cloneNode(true))),
      ...shapes(force_scale),
    );
    this.#stage.setAttribute("aria-label", `t = ${frame.time.toFixed(4)} s: ${words[frame.words] ?? ""}`);
    this.#time.value = index;
    this.#time.setAttribute("aria-valuetext", `${frame.time.toFixed(3)} s`);
    this.#clock.textContent = `t = ${frame.time.toFixed(4)} s`;
    const told = `Mode ${frame.mode}: ${words[frame.words] ?? ""}`;
    if (this.#words.textContent !== told) this.#words.textContent = told;
    this.#play.textContent = this.#started === null ? "Play" : "Pause";
    const last = events.filter(([time]) => time <= frame.time).length - 1;
    [...this.#log.children].forEach((line, number) => line.classList.toggle("now", number === last));
  }

  #rest(index) {
    this.#started = null;
    this.#paint(index);
  }

  #start() {
    const last = this.#film.frames.length - 1;
    const first = this.#frame >= last ? 0 : this.#frame;
    const pause = 1000 * this.#film.frame_time;
    const run = (this.#started = {});
    const begun = performance.now() - pause * first;
    this.#paint(first);
    const tick = (now) => {
      if (this.#started !== run) return;
      const index = Math.max(0, Math.floor((now - begun) / pause));
      if (index >= last) return this.#rest(last);
      if (index !== this.#frame) this.#paint(index);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
}
