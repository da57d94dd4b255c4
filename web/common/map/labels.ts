// SPDX-License-Identifier: Apache-2.0
/**
 * Names of aircraft: chosen a few times a second so that they do not pile up, and moved with each
 * frame by the graphics card. Their pictures lie in one texture, each in a slot of its own.
 */
import type { Theme } from "../theme";
import { kBefore, kMotion, kNow, type Fleet } from "../fleet";
import type { Boxes } from "./field_view";
import type { Projector } from "./projector";

const kSlotWide = 204,
  kSlotHigh = 50,
  kColumns = 5,
  kRows = 15; // [CSS px]
const kMost = kColumns * kRows - 1; // the last slot is the ring of who is chosen
const kName = "600 12px system-ui, 'Segoe UI', Roboto, sans-serif";
const kLine = "11px system-ui, 'Segoe UI', Roboto, sans-serif";
const kPad = 4,
  kHigh = 15;
const kCrowd = 150; // aircraft that are seen
const kInstance = 16; // floats: before, now, rectangle on the screen, place in the texture
const kRing = 50; // width of the ring's picture

export interface LabelText {
  name: string;
  line: string; // what it does; may be empty
  warned: boolean;
}

interface Slot {
  row: number;
  key: string;
  width: number;
  height: number;
  used: number; // placement that used it last
}

export class Labels {
  readonly instances = new Float32Array(192 * kInstance); // rows of a texture of floats
  count = 0;
  private rows = new Int32Array(kMost + 64);
  private readonly slots: Slot[] = Array.from({ length: kMost }, () => ({ row: -1, key: "", width: 0, height: 0, used: -1 }));
  private readonly slotOf = new Map<number, number>();
  private readonly taken: number[] = [];
  private readonly pose = new Float64Array(4);
  private readonly ratio = Math.min(2, window.devicePixelRatio || 1);
  private readonly context: CanvasRenderingContext2D; // of one slot
  /** Puts the picture of a slot into the texture. */
  onPicture: (x: number, y: number, picture: HTMLCanvasElement) => void = () => undefined;
  private shown = new Set<number>(); // rows whose label stands
  private fresh = 0; // pictures that may still be made in this placement
  private placement = 0;
  private copied = -1;
  private ringTheme = "";
  constructor() {
    const canvas = document.createElement("canvas");
    canvas.width = kSlotWide * this.ratio;
    canvas.height = kSlotHigh * this.ratio;
    this.context = canvas.getContext("2d", { willReadFrequently: true })!;
  }

  get textureSize(): [number, number] {
    return [kColumns * kSlotWide, kRows * kSlotHigh];
  }
  get texturePixels(): [number, number] {
    return [kColumns * kSlotWide * this.ratio, kRows * kSlotHigh * this.ratio];
  }

  /** Pictures are made anew, in other colours. */
  forget(): void {
    for (const slot of this.slots) slot.key = "";
    this.ringTheme = "";
  }

  private begin(): CanvasRenderingContext2D {
    const c = this.context;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, kSlotWide, kSlotHigh);
    return c;
  }
  private end(index: number): void {
    this.onPicture((index % kColumns) * kSlotWide * this.ratio, Math.floor(index / kColumns) * kSlotHigh * this.ratio, this.context.canvas);
  }

  private ring(theme: Theme): void {
    if (this.ringTheme === theme.ink) return;
    this.ringTheme = theme.ink;
    const c = this.begin();
    for (const [colour, width] of [
      [theme.paper, 4.5],
      [theme.ink, 2],
    ] as const) {
      c.strokeStyle = colour;
      c.lineWidth = width;
      c.beginPath();
      c.arc(kRing / 2, kRing / 2, 22, 0, 7);
      c.stroke();
    }
    this.end(kMost);
  }

  /** The slot with an aircraft's label; -1 where none is free. */
  private slot(row: number, { name, line, warned }: LabelText, theme: Theme, warnedColour: string, chosen: boolean): number {
    const key = `${name}|${line}|${warned}|${chosen}`;
    let index = this.slotOf.get(row) ?? -1;
    if (index < 0) {
      index = this.slots.findIndex(({ used }) => used < this.placement - 1);
      if (index < 0) return -1;
      this.slotOf.delete(this.slots[index].row);
      this.slotOf.set(row, index);
      this.slots[index].row = row;
      this.slots[index].key = "";
    }
    const slot = this.slots[index];
    if (slot.key === key) return index;
    // A few new pictures at a time; a label that stands already keeps its old text for a moment.
    if (this.fresh <= 0 && !chosen) return slot.key === "" ? -1 : index;
    --this.fresh;
    slot.key = key;
    const c = this.begin(),
      most = kSlotWide - 2 * kPad - 2;
    c.font = kName;
    const nameWide = Math.min(c.measureText(name).width, most - 16);
    c.font = kLine;
    const wide = Math.min(most, Math.max(nameWide + (warned ? 15 : 0), line ? c.measureText(line).width : 0));
    slot.width = Math.ceil(wide) + 2 * kPad + 2;
    slot.height = (line ? 2 : 1) * kHigh + 4;
    c.globalAlpha = chosen ? 1 : 0.88;
    c.fillStyle = theme.paper;
    c.beginPath();
    c.roundRect(0.75, 0.75, slot.width - 1.5, slot.height - 1.5, 4);
    c.fill();
    c.globalAlpha = 1;
    c.strokeStyle = warned ? warnedColour : chosen ? theme.ink : theme.grid;
    c.lineWidth = chosen || warned ? 1.5 : 1;
    c.stroke();
    c.font = kName;
    c.fillStyle = theme.ink;
    c.fillText(name, kPad + 1, kHigh - 2, most - 16);
    if (warned) {
      c.fillStyle = warnedColour;
      c.fillText("⚠", kPad + nameWide + 3, kHigh - 2);
    }
    c.font = kLine;
    c.fillStyle = theme.ink;
    if (line) c.fillText(line, kPad + 1, 2 * kHigh - 2, most);
    this.end(index);
    return index;
  }

  private free(x: number, y: number, w: number, h: number): boolean {
    const t = this.taken;
    for (let i = 0; i < t.length; i += 4) if (x < t[i + 2] && t[i] < x + w && y < t[i + 3] && t[i + 1] < y + h) return false;
    return true;
  }

  private add(row: number, dx: number, dy: number, width: number, height: number, slot: number): void {
    const at = this.count * kInstance + 8,
      out = this.instances;
    out[at] = dx;
    out[at + 1] = dy;
    out[at + 2] = width;
    out[at + 3] = height;
    out[at + 4] = (slot % kColumns) * kSlotWide;
    out[at + 5] = Math.floor(slot / kColumns) * kSlotHigh;
    this.rows[this.count++] = row;
  }

  private locate(fleet: Fleet, camera: Projector, time: number, row: number): boolean {
    fleet.pose(row, time, this.pose);
    return camera.project(this.pose[0], this.pose[1], this.pose[2]) && camera.x > 0 && camera.y > 0 && camera.x < camera.width && camera.y < camera.height;
  }

  /** Chooses which labels stand where: the chosen and the warned first, then as many as fit. */
  place(
    fleet: Fleet,
    camera: Projector,
    time: number,
    selected: ReadonlySet<number>,
    text: ((row: number) => LabelText) | null,
    theme: Theme,
    warnedColour: string,
    others: Boxes,
  ): void {
    this.count = 0;
    this.taken.length = 0;
    this.copied = -1;
    ++this.placement;
    this.ring(theme);
    for (const id of selected) {
      const row = fleet.row(id);
      if (row >= 0 && this.count < 64) this.add(row, -kRing / 2, -kRing / 2, kRing, kRing, kMost);
    }
    if (!text) return;
    const rings = this.count,
      many = fleet.count > 60;
    const order: number[] = [],
      later: number[] = [],
      before = this.shown;
    this.shown = new Set();
    this.fresh = many ? 6 : kMost;
    for (let row = 0; row < fleet.count; ++row) {
      if (!this.locate(fleet, camera, time, row)) continue;
      if (selected.has(fleet.ids[row])) order.unshift(row);
      else if (fleet.get(row, "failsafe") > 0) order.push(row);
      else if (before.has(row))
        later.unshift(row); // labels that stand stay
      else if (later.length < 400) later.push(row);
      if (!many) this.taken.push(camera.x - 9, camera.y - 9, camera.x + 9, camera.y + 9); // no label on an aircraft
    }
    // Where more are seen than could be told apart, only the chosen and the warned are named.
    const rest = later.length > kCrowd ? [] : later;
    for (const row of order.concat(rest)) {
      if (this.count - rings >= (many ? 40 : kMost)) break;
      const chosen = selected.has(fleet.ids[row]);
      this.locate(fleet, camera, time, row);
      const { x, y } = camera,
        label = text(row);
      if (many && !chosen) label.line = "";
      const index = this.slot(row, label, theme, warnedColour, chosen);
      if (index < 0) continue;
      const { width, height } = this.slots[index];
      for (const [dx, dy] of [
        [15, -height - 6],
        [15, 8],
        [-width - 15, -height - 6],
        [-width - 15, 8],
        [-width / 2, 18],
        [-width / 2, -height - 18],
      ]) {
        if (!chosen && !(this.free(x + dx, y + dy, width, height) && others.free(x + dx, y + dy, width, height))) continue;
        this.taken.push(x + dx, y + dy, x + dx + width, y + dy + height);
        this.slots[index].used = this.placement;
        this.shown.add(row);
        this.add(row, dx, dy, width, height, index);
        break;
      }
    }
  }

  /** Brings the motions up to date; returns whether the instances have changed. */
  refresh(fleet: Fleet): boolean {
    if (this.copied === fleet.version) return false;
    this.copied = fleet.version;
    for (let i = 0; i < this.count; ++i) {
      const from = this.rows[i] * kMotion,
        at = i * kInstance;
      for (let k = 0; k < 4; ++k) {
        this.instances[at + k] = fleet.motion[from + kBefore + k];
        this.instances[at + 4 + k] = fleet.motion[from + kNow + k];
      }
    }
    return true;
  }
}
