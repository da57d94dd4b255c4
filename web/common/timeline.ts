// SPDX-License-Identifier: Apache-2.0
/** Events along the time of the run, and in a replay the slider that moves through it. */
import { clock, h } from "./dom";
import { eventLook } from "./events";
import { onThemeChange, theme } from "./theme";
import { T } from "./texts";
import { iconButton } from "./ui";
import type { RunView } from "./view";
import type { KeptEvent } from "./world";

const kHigh = 54; // [px]

/** Moves through the time of a replay. */
export function timeSlider(view: RunView): HTMLInputElement {
  let dragging = false;
  const seek = () => view.seek(Number(slider.value));
  const slider = h("input", {
    type: "range",
    min: 0,
    max: view.end,
    step: 0.1,
    "aria-label": T.replay.slider,
    class: "seek",
    oninput: () => {
      dragging = true;
      if (view.seeksAtOnce) seek();
    },
    onchange: () => {
      dragging = false;
      seek();
    },
  });
  view.every(() => {
    // Where seeking takes its time, the slider stays where it was put.
    if (!dragging && (view.seeksAtOnce || document.activeElement !== slider)) slider.value = String(view.world.time);
  });
  return slider;
}

/** To the begin of a replay, and from event to event. */
export function replayButtons(view: RunView, events: () => readonly KeptEvent[] = () => view.events): HTMLElement {
  const jump = (by: number) => {
    const { time } = view.world;
    const next = by > 0 ? events().find((e) => e.time_s > time + 0.5) : [...events()].reverse().find((e) => e.time_s < time - 1);
    if (next) view.seek(next.time_s);
  };
  return h(
    "div",
    { class: "replay-buttons" },
    iconButton("first", T.replay.begin, () => view.seek(0)),
    iconButton("previous", T.replay.previous, () => jump(-1)),
    iconButton("next", T.replay.next, () => jump(1)),
  );
}

export class Timeline {
  readonly element: HTMLElement;
  private readonly canvas = h("canvas", { class: "timeline-canvas", "aria-hidden": "true" });
  private readonly tip = h("div", { class: "timeline-tip", hidden: true });
  private shown = "";

  /** @param isOneOfSeveral  what moves through the time is elsewhere, for all of them */
  constructor(
    private readonly view: RunView,
    isOneOfSeveral = false,
  ) {
    const moves = view.run.replay && !isOneOfSeveral;
    const stack = h("div", { class: "timeline-stack" }, this.canvas, this.tip, moves ? timeSlider(view) : null);
    this.element = h(
      "div",
      { class: "timeline", role: isOneOfSeveral ? "group" : "region", "aria-label": T.timeline.title },
      moves ? replayButtons(view) : null,
      stack,
    );
    this.canvas.addEventListener("pointermove", (event) => this.point(event));
    this.canvas.addEventListener("pointerleave", () => {
      this.tip.hidden = true;
    });
    this.canvas.addEventListener("click", (event) => {
      const found = this.nearest(event);
      if (found) view.jumpTo(found);
      else if (view.run.replay) view.seek(this.timeAt(event.offsetX));
    });
    new ResizeObserver(() => {
      this.shown = "";
    }).observe(this.canvas);
    onThemeChange(() => {
      this.shown = "";
    });
    view.every(() => this.update());
  }

  private timeAt(x: number): number {
    return (x / Math.max(1, this.canvas.clientWidth)) * this.view.end;
  }

  private nearest(event: PointerEvent | MouseEvent): KeptEvent | null {
    const time = this.timeAt(event.offsetX),
      reach = this.timeAt(7),
      row = Math.floor((event.offsetY / kHigh) * 3);
    let best: KeptEvent | null = null,
      least = Infinity;
    for (const each of this.view.events) {
      const d = Math.abs(each.time_s - time) + (eventLook(each).row === row ? 0 : reach / 2);
      if (d < reach && d < least) {
        least = d;
        best = each;
      }
    }
    return best;
  }

  private point(event: PointerEvent): void {
    const found = this.nearest(event);
    this.tip.hidden = !found;
    this.canvas.style.cursor = found || this.view.run.replay ? "pointer" : "default";
    if (!found) return;
    this.tip.textContent = T.timeline.event(clock(found.time_s), `${this.view.world.whose(found)}: ${found.kind}. ${found.text}`);
    this.tip.style.left = `${Math.min(event.offsetX, this.canvas.clientWidth - this.tip.offsetWidth - 6)}px`;
  }

  private update(): void {
    const { world } = this.view,
      width = this.canvas.clientWidth;
    const key = `${world.version.events} ${Math.round((world.time / this.view.end) * width)} ${width} ${theme().dark}`;
    if (key === this.shown || width === 0) return;
    this.shown = key;
    this.draw(width);
  }

  private draw(width: number): void {
    const { world } = this.view,
      ratio = Math.min(2, devicePixelRatio || 1),
      colours = theme(),
      c = this.canvas.getContext("2d")!;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(kHigh * ratio);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    const x = (time: number) => (time / this.view.end) * width,
      axis = kHigh - 15;
    c.fillStyle = colours.grid;
    c.fillRect(0, axis - 1, width, 1.5);
    c.fillStyle = colours.belief;
    c.globalAlpha = 0.16;
    c.fillRect(0, 0, x(world.time), axis);
    c.globalAlpha = 1;
    c.font = "11px system-ui, sans-serif";
    c.fillStyle = colours.muted;
    const step = [10, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400].find((s) => x(s) > 70) ?? 28800;
    for (let t = 0; t <= this.view.end; t += step) {
      const at = x(t);
      c.fillRect(at, axis - 4, 1, 5);
      const text = clock(t),
        wide = c.measureText(text).width;
      c.fillText(text, Math.max(1, Math.min(width - wide - 1, at - wide / 2)), kHigh - 2);
    }
    for (const event of this.view.events) {
      const { row, shape } = eventLook(event),
        at = x(event.time_s),
        y = 6 + row * 11;
      c.fillStyle = shape === "triangle" ? colours.warning : shape === "square" ? colours.zone : colours.belief;
      c.beginPath();
      if (shape === "triangle") {
        c.moveTo(at, y - 5);
        c.lineTo(at + 5, y + 4);
        c.lineTo(at - 5, y + 4);
      } else if (shape === "square") c.rect(at - 3.5, y - 3.5, 7, 7);
      else c.arc(at, y, 3, 0, 7);
      c.fill();
    }
    c.fillStyle = colours.ink;
    c.fillRect(x(world.time) - 1, 0, 2, axis + 2);
  }
}
