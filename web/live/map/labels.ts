/** Names of aircraft: chosen a few times a second so that they do not pile up, moved with each frame. */
import type { Theme } from "../../report/theme";
import type { Fleet } from "../fleet";
import type { Projector } from "./projector";

const kMost = 70;
const kName = "600 12px system-ui, 'Segoe UI', Roboto, sans-serif";
const kLine = "11px system-ui, 'Segoe UI', Roboto, sans-serif";
const kPad = 4, kHigh = 15;

export interface LabelText {
  name: string;
  line: string; // what it does; may be empty
  warned: boolean;
}

interface Sprite {
  canvas: HTMLCanvasElement;
  width: number;
  height: number;
  key: string;
}

interface Placed {
  row: number;
  dx: number;
  dy: number;
  sprite: Sprite;
}

export class Labels {
  private placed: Placed[] = [];
  private readonly sprites = new Map<number, Sprite>();
  private readonly taken: number[] = [];
  private readonly pose = new Float64Array(4);

  /** Pictures are made anew, in other colours. */
  forget(): void {
    this.sprites.clear();
  }

  private sprite(row: number, { name, line, warned }: LabelText, theme: Theme, warnedColour: string, chosen: boolean): Sprite {
    const key = `${name}|${line}|${warned}|${chosen}`;
    const known = this.sprites.get(row);
    if (known?.key === key) return known;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const canvas = known?.canvas ?? document.createElement("canvas"), c = canvas.getContext("2d")!;
    c.font = kName;
    const first = c.measureText(name).width + (warned ? 14 : 0);
    c.font = kLine;
    const width = Math.ceil(Math.max(first, line ? c.measureText(line).width : 0)) + 2 * kPad + 2;
    const height = (line ? 2 : 1) * kHigh + 4;
    canvas.width = Math.ceil(width * ratio);
    canvas.height = Math.ceil(height * ratio);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.globalAlpha = chosen ? 1 : 0.86;
    c.fillStyle = theme.paper;
    c.beginPath();
    c.roundRect(0.5, 0.5, width - 1, height - 1, 4);
    c.fill();
    c.globalAlpha = 1;
    c.strokeStyle = warned ? warnedColour : chosen ? theme.ink : theme.grid;
    c.lineWidth = chosen || warned ? 1.5 : 1;
    c.stroke();
    c.font = kName;
    c.fillStyle = theme.ink;
    c.fillText(name, kPad, kHigh - 2);
    if (warned) {
      c.fillStyle = warnedColour;
      c.fillText("⚠", kPad + c.measureText(name).width + 3, kHigh - 2);
    }
    c.font = kLine;
    c.fillStyle = theme.ink;
    if (line) c.fillText(line, kPad, 2 * kHigh - 2);
    const made = { canvas, width, height, key };
    this.sprites.set(row, made);
    return made;
  }

  private free(x: number, y: number, w: number, h: number): boolean {
    const t = this.taken;
    for (let i = 0; i < t.length; i += 4)
      if (x < t[i + 2] && t[i] < x + w && y < t[i + 3] && t[i + 1] < y + h) return false;
    return true;
  }

  /** Chooses which labels stand where: the chosen and the warned first, then as many as fit. */
  place(fleet: Fleet, camera: Projector, time: number, selected: ReadonlySet<number>, text: (row: number) => LabelText,
    theme: Theme, warnedColour: string): void {
    this.placed = [];
    this.taken.length = 0;
    const many = fleet.count > 60;
    const order: number[] = [], later: number[] = [];
    for (let row = 0; row < fleet.count; ++row) {
      fleet.pose(row, time, this.pose);
      if (!camera.project(this.pose[0], this.pose[1], this.pose[2])) continue;
      const { x, y } = camera;
      if (x < 0 || y < 0 || x > camera.width || y > camera.height) continue;
      const id = fleet.ids[row];
      if (selected.has(id) || fleet.get(row, "failsafe") > 0) order.push(row);
      else later.push(row);
      if (!many) this.taken.push(x - 9, y - 9, x + 9, y + 9); // no label on an aircraft
    }
    for (const row of order.concat(later)) {
      if (this.placed.length >= kMost) break;
      const id = fleet.ids[row], chosen = selected.has(id);
      fleet.pose(row, time, this.pose);
      camera.project(this.pose[0], this.pose[1], this.pose[2]);
      const { x, y } = camera, label = text(row);
      if (many && !chosen) label.line = "";
      const sprite = this.sprite(row, label, theme, warnedColour, chosen), { width, height } = sprite;
      for (const [dx, dy] of [[15, -height - 6], [15, 8], [-width - 15, -height - 6], [-width - 15, 8], [-width / 2, 18], [-width / 2, -height - 18]]) {
        if (!chosen && !this.free(x + dx, y + dy, width, height)) continue;
        this.taken.push(x + dx, y + dy, x + dx + width, y + dy + height);
        this.placed.push({ row, dx, dy, sprite });
        break;
      }
    }
  }

  draw(c: CanvasRenderingContext2D, fleet: Fleet, camera: Projector, time: number, selected: ReadonlySet<number>, theme: Theme): void {
    c.clearRect(0, 0, camera.width, camera.height);
    for (const id of selected) {
      const row = fleet.row(id);
      if (row < 0) continue;
      fleet.pose(row, time, this.pose);
      if (!camera.project(this.pose[0], this.pose[1], this.pose[2])) continue;
      const { x, y } = camera;
      c.strokeStyle = theme.paper;
      c.lineWidth = 4;
      c.beginPath();
      c.arc(x, y, 23, 0, 7);
      c.stroke();
      c.strokeStyle = theme.ink;
      c.lineWidth = 2;
      c.stroke();
    }
    for (let i = 0; i < this.placed.length; ++i) {
      const { row, dx, dy, sprite } = this.placed[i];
      if (row >= fleet.count) continue;
      fleet.pose(row, time, this.pose);
      if (!camera.project(this.pose[0], this.pose[1], this.pose[2])) continue;
      c.drawImage(sprite.canvas, Math.round(camera.x + dx), Math.round(camera.y + dy), sprite.width, sprite.height);
    }
  }
}
