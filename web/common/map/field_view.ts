// SPDX-License-Identifier: Apache-2.0
/** What those who draw on the canvas of the field are given, and what they have in common. */
import type { Theme } from "../theme";
import type { Layers } from "../settings";
import type { World } from "../world";
import type { Projector } from "./projector";
import type { Shaper } from "./shapes";

/** From so many aircraft on, only chosen ones show where their tasks lead. */
export const kMany = 40;
export const kFont = "12px system-ui, 'Segoe UI', Roboto, sans-serif";

export interface FieldView {
  world: World;
  camera: Projector;
  shaper: Shaper;
  theme: Theme;
  layers: Layers;
  time: number;
  selected: ReadonlySet<number>;
  grid: { north_m: number; east_m: number; half_m: number } | null; // where there is no relief to see
}

/** Boxes of labels that stand already: others keep off. */
export class Boxes {
  private readonly taken: number[] = [];
  clear(): void {
    this.taken.length = 0;
  }
  free(x: number, y: number, width: number, height: number): boolean {
    const t = this.taken;
    for (let i = 0; i < t.length; i += 4) if (x < t[i + 2] && t[i] < x + width && y < t[i + 3] && t[i + 1] < y + height) return false;
    return true;
  }
  add(x: number, y: number, width: number, height: number): void {
    this.taken.push(x, y, x + width, y + height);
  }
}

export function writeLabel(c: CanvasRenderingContext2D, text: string, x: number, y: number, colour: string, paper: string): void {
  c.save();
  c.font = kFont;
  c.lineWidth = 3.5;
  c.lineJoin = "round";
  c.strokeStyle = paper;
  c.strokeText(text, x, y);
  c.fillStyle = colour;
  c.fillText(text, x, y);
  c.restore();
}

const place = new Float64Array(3);

export function spot(v: FieldView, north: number | null, east: number | null): boolean {
  if (north == null || east == null) return false;
  v.shaper.one(north, east, place);
  return v.camera.project(place[0], place[1], place[2]);
}

/** Writes a text where it is free, if it is. */
export function put(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes, text: string, x: number, y: number, colour: string): void {
  c.font = kFont;
  const width = c.measureText(text).width;
  for (const [dx, dy] of [
    [11, 4],
    [-11 - width, 4],
    [-width / 2, -12],
    [-width / 2, 20],
  ]) {
    if (!boxes.free(x + dx - 3, y + dy - 12, width + 6, 16)) continue;
    boxes.add(x + dx - 3, y + dy - 12, width + 6, 16);
    writeLabel(c, text, x + dx, y + dy, colour, v.theme.paper);
    return;
  }
}
