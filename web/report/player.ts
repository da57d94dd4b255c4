/** The animated map: canvas, time slider, layers, keys. */
import { floats, shorts, type RunData } from "./data";
import { clock, h, number } from "./dom";
import { drawMap, fit, kAllLayers, kMany, type Layers, type View } from "./map_draw";
import { Scene } from "./scene";
import { onThemeChange, paperTheme, theme } from "./theme";
import { alertStrip, type AlertStrip } from "./alert_strip";

interface Shown {
  run: RunData;
  scene: Scene;
  heights: Uint16Array | null;
  metricTimes: Float32Array;
  metrics: Record<string, Float32Array>;
}

const kSpeeds = [1, 5, 10, 30, 60, 120, 300];
const kLayerNames: [keyof Layers, string, string][] = [
  ["truth", "true fire", "truth"],
  ["belief", "believed boundary", "belief"],
  ["band", "95 % band", "band"],
  ["ahead", "forecasts", "ahead"],
  ["tracks", "tracks", "track"],
  ["crossings", "crossings", "crossing"],
  ["objects", "objects, and where they were seen", "object"],
  ["traffic", "other aircraft, where they are believed, alerts", "traffic"],
  ["missions", "areas and lines of missions", "mission"],
  ["zones", "no-fly zones", "zone"],
  ["names", "names", ""],
  ["terrain", "terrain", ""],
];

function prepare(run: RunData): Shown | null {
  if (!run.map) return null;
  const columns = Object.entries(run.metrics.columns).map(([name, packed]) => [name, floats(packed)] as const);
  return {
    run,
    scene: new Scene(run, run.map),
    heights: run.map.terrain ? shorts(run.map.terrain.heights) : null,
    metricTimes: floats(run.metrics.time_s),
    metrics: Object.fromEntries(columns),
  };
}

/** Key figures at a time, as one line of text. */
function figuresAt(shown: Shown, time: number): string {
  let i = shown.metricTimes.length - 1;
  while (i > 0 && shown.metricTimes[i] > time + 1e-3) --i;
  if (i < 0 || shown.metricTimes[i] > time + 1e-3) return "";
  const part = (label: string, column: string, unit: string) => {
    const value = shown.metrics[column]?.[i];
    return value != null && Number.isFinite(value) ? [`${label} ${number(value)}${unit}`] : [];
  };
  return [...part("Perf", "perf_m", " m"), ...part("boundary RMS", "boundary_rms_m", " m"),
    ...part("IoU", "iou", ""), ...part("coverage", "coverage_95", "")].join(" · ");
}

export class Player {
  readonly element: HTMLElement;
  /** Called whenever another time is shown, or another run. */
  onTime: (time: number, scene: Scene) => void = () => undefined;
  private readonly shown: Shown[];
  private current: Shown;
  private readonly layers: Layers = { ...kAllLayers };
  private view: View = { north: 0, east: 0, scale: 1 };
  private viewChanged = false;
  private time = 0;
  private speed = 60;
  private playing = false;
  private lastFrame = 0;
  private readonly end: number;
  private readonly canvas = h("canvas", { tabindex: 0, role: "img", class: "map" });
  private readonly slider: HTMLInputElement;
  private readonly playButton: HTMLButtonElement;
  private readonly clockText = h("output", { class: "clock" });
  private readonly status = h("p", { class: "status" });
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private waiting = false;
  private readonly strip: AlertStrip | null;

  /** What is on the map. */
  get scene(): Scene {
    return this.current.scene;
  }

  /** Makes a player of the runs that have a map; null when none has. */
  static make(runs: RunData[]): Player | null {
    const shown = runs.map(prepare).filter((s): s is Shown => s !== null);
    return shown.length > 0 ? new Player(shown) : null;
  }

  private constructor(shown: Shown[]) {
    this.shown = shown;
    this.current = shown[0];
    this.end = Math.max(...shown.map((s) => s.scene.duration));
    if (shown.some((s) => s.scene.tracks.length > kMany)) this.layers.tail = 20;
    this.time = this.end; // the first look is at the result; playing starts at the beginning
    this.slider = h("input", { type: "range", min: 0, max: Math.max(this.end, 0.1), step: "any", value: this.end,
      "aria-label": "Simulated time", class: "time",
      oninput: () => { this.pause(); this.seek(Number(this.slider.value)); } });
    this.playButton = h("button", { type: "button", class: "play", onclick: () => this.toggle() }, "▶ Play");
    const speed = h("select", { "aria-label": "Speed",
      onchange: () => { this.speed = Number(speed.value); } },
      ...kSpeeds.map((s) => h("option", { value: s, selected: s === this.speed }, `${s}×`)));
    const tail = h("select", { "aria-label": "Length of the tracks",
      onchange: () => { this.layers.tail = Number(tail.value); this.draw(); } },
      ...([[20, "20 s"], [60, "1 min"], [180, "3 min"], [600, "10 min"], [1e9, "all"]] as const).map(([s, text]) =>
        h("option", { value: s, selected: s === this.layers.tail }, text)));
    const button = (label: string, text: string, action: () => void) =>
      h("button", { type: "button", "aria-label": label, title: label, onclick: action }, text);

    this.strip = alertStrip(this.current.run, this.current.scene, this.end, (time) => { this.pause(); this.seek(time); });
    this.element = h("div", { class: "player", onkeydown: (event) => this.key(event as KeyboardEvent) },
      this.runChoice(),
      h("div", { class: "map-holder" }, this.canvas,
        h("div", { class: "zoom" }, button("Zoom in", "+", () => this.zoom(1.4)),
          button("Zoom out", "−", () => this.zoom(1 / 1.4)), button("Show everything", "⤢", () => this.showAll()))),
      h("div", { class: "controls" }, this.playButton, this.slider, this.clockText,
        h("label", {}, "Speed ", speed), h("label", {}, "Tracks ", tail)),
      this.strip?.element,
      this.layerChoice(),
      this.status,
      h("p", { class: "hint" }, "Drag to move, wheel to zoom. Keys: space plays, , and . step, + − 0 zoom, arrows move."));
    this.listen();
    this.figures().forEach((figure) => this.element.append(figure));
  }

  private runChoice(): HTMLElement | null {
    if (this.shown.length < 2) return null;
    return h("fieldset", { class: "runs" }, h("legend", {}, "Run on the map"),
      ...this.shown.map((shown, i) => h("label", {},
        h("input", { type: "radio", name: "map-run", checked: i === 0,
          onchange: () => { this.current = shown; this.draw(); } }), ` ${shown.run.label}`)));
  }

  private layerChoice(): HTMLElement {
    const has: Partial<Record<keyof Layers, (s: Shown) => boolean>> = {
      terrain: (s) => s.heights !== null,
      objects: (s) => s.scene.objects.length + s.scene.detections.time.length > 0,
      traffic: (s) => s.scene.traffic.length + s.scene.trafficBeliefs.length > 0,
      missions: (s) => s.scene.missions.length > 0,
      zones: (s) => s.scene.zones.length > 0,
    };
    const there = (key: keyof Layers) => this.shown.some((s) => has[key]?.(s) ?? true);
    return h("div", { class: "layers", role: "group", "aria-label": "What the map shows" },
      ...kLayerNames.filter(([key]) => there(key)).map(([key, text, style]) =>
        h("label", {},
          h("input", { type: "checkbox", checked: true, onchange: (event) => {
            (this.layers[key] as boolean) = (event.target as HTMLInputElement).checked;
            this.draw();
          } }),
          style ? h("span", { class: `key ${style}`, "aria-hidden": "true" }) : null, ` ${text}`)));
  }

  private listen(): void {
    const canvas = this.canvas;
    new ResizeObserver(() => {
      if (!this.viewChanged) this.view = fit(this.current.scene, canvas.clientWidth, canvas.clientHeight);
      this.draw();
    }).observe(canvas);
    onThemeChange(() => this.draw());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const)
      canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
  }

  private move(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = { x: event.offsetX, y: event.offsetY };
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.pointers.set(event.pointerId, now);
    if (other) {
      const length = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y);
      this.zoom(length(now) / Math.max(length(before), 1), other.x, other.y);
    } else {
      this.pan(before.x - now.x, before.y - now.y);
    }
  }

  private pan(x: number, y: number): void {
    this.viewChanged = true;
    this.view.east += x / this.view.scale;
    this.view.north -= y / this.view.scale;
    this.draw();
  }

  private zoom(factor: number, x = this.canvas.clientWidth / 2, y = this.canvas.clientHeight / 2): void {
    this.viewChanged = true;
    const dx = x - this.canvas.clientWidth / 2, dy = y - this.canvas.clientHeight / 2;
    const scale = Math.min(Math.max(this.view.scale * factor, 1e-4), 50);
    this.view.east += dx / this.view.scale - dx / scale;
    this.view.north -= dy / this.view.scale - dy / scale;
    this.view.scale = scale;
    this.draw();
  }

  private showAll(): void {
    this.viewChanged = false;
    this.view = fit(this.current.scene, this.canvas.clientWidth, this.canvas.clientHeight);
    this.draw();
  }

  private key(event: KeyboardEvent): void {
    const onMap = event.target === this.canvas;
    const step = 40;
    const actions: Record<string, () => void> = {
      ".": () => this.seek(this.time + 10),
      ",": () => this.seek(this.time - 10),
      ...(onMap ? {
        " ": () => this.toggle(), "+": () => this.zoom(1.4), "-": () => this.zoom(1 / 1.4),
        "0": () => this.showAll(),
        ArrowLeft: () => this.pan(-step, 0), ArrowRight: () => this.pan(step, 0),
        ArrowUp: () => this.pan(0, -step), ArrowDown: () => this.pan(0, step),
      } : {}),
    };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  private toggle(): void {
    if (this.playing) return this.pause();
    if (this.time >= this.end) this.time = 0;
    this.playing = true;
    this.playButton.textContent = "❚❚ Pause";
    this.lastFrame = performance.now();
    requestAnimationFrame((now) => this.tick(now));
  }

  private pause(): void {
    this.playing = false;
    this.playButton.textContent = "▶ Play";
  }

  private tick(now: number): void {
    if (!this.playing) return;
    // A hidden page gets no frames: do not jump when it comes back.
    const passed = Math.min(now - this.lastFrame, 200) / 1000;
    this.lastFrame = now;
    this.seek(this.time + passed * this.speed);
    if (this.time >= this.end) this.pause();
    else requestAnimationFrame((next) => this.tick(next));
  }

  /** Shows the time `seconds`, within the run. */
  seek(seconds: number): void {
    this.time = Math.min(Math.max(seconds, 0), this.end);
    this.slider.value = String(this.time);
    this.draw();
  }

  private draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.drawNow();
    });
  }

  private drawNow(): void {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    const text = `${clock(this.time)} of ${clock(this.end)}`;
    this.clockText.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
    this.status.textContent = figuresAt(this.current, this.time);
    this.onTime(this.time, this.current.scene);
    this.strip?.showTime(this.time);
    if (width === 0 || height === 0) return;
    this.canvas.setAttribute("aria-label",
      `Map of ${this.current.run.label} at ${text}. ${this.status.textContent}`);
    paint(this.canvas, width, height, (context) =>
      drawMap(context, this.current.scene, this.current.heights, this.time, this.view, width, height,
        this.layers, theme()));
  }

  /** Maps at a few times, for paper. */
  private figures(): HTMLElement[] {
    const width = 480, height = 360;
    return this.shown.slice(0, 4).map((shown) => {
      const times = [0, 1 / 3, 2 / 3, 1].map((part) => part * shown.scene.duration);
      const view = fit(shown.scene, width, height);
      const layers = { ...kAllLayers, tail: this.layers.tail };
      return h("div", { class: "print-maps" },
        h("p", {}, "Red: true fire. Dashed blue: believed boundary, shaded: its 95 % band. " +
          `Dots: crossings of the last five minutes. Squares: objects, filled once found; crosses: where cameras placed them. Diamonds: other aircraft; circles: where they are believed, amber and red with an alert. ` +
          `Coloured lines: the last ${clock(this.layers.tail)} of flight.`),
        ...times.map((time) => {
          const canvas = h("canvas");
          paint(canvas, width, height, (context) =>
            drawMap(context, shown.scene, shown.heights, time, view, width, height, layers, paperTheme));
          return h("figure", {}, canvas, h("figcaption", {},
            `${this.shown.length > 1 ? `${shown.run.label}, ` : ""}${clock(time)}. ${figuresAt(shown, time)}`));
        }));
    });
  }
}

/** Sizes a canvas for sharp lines and draws in CSS pixels. */
export function paint(canvas: HTMLCanvasElement, width: number, height: number,
  draw: (context: CanvasRenderingContext2D) => void): void {
  const ratio = Math.max(window.devicePixelRatio || 1, 1);
  const [w, k] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== k) {
    canvas.width = w;
    canvas.height = k;
  }
  const context = canvas.getContext("2d")!;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  draw(context);
}
