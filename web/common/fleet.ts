// SPDX-License-Identifier: Apache-2.0
/**
 * Where all aircraft are: one typed array for what was said last, one for what is drawn.
 *
 * Frames are read straight from the message into numbers: at a thousand aircraft ten times a second
 * objects would keep the garbage collector busy.
 */
import type { Frame } from "./frames";
import { Tracks } from "./tracks";
import { Decoder, type Columns, type Reader } from "./wire";

/** Floats of an aircraft in `Fleet.motion`: the place before and now, headings, state. */
export const kMotion = 16;
/** Places in a motion: x east, y south, altitude [m], time [s]; then the same of now. */
export const kBefore = 0,
  kNow = 4,
  kHeadings = 8,
  kIcon = 10,
  kTint = 11,
  kGround = 12,
  kHeard = 13,
  kRadius = 14;

const kTailPoint = 4; // x, y, altitude, time
/** Points of a tail, a second apart at least, by the number of aircraft. */
const kTails: [upTo: number, length: number][] = [
  [8, 300],
  [40, 120],
  [300, 40],
  [Infinity, 12],
];

/** Tails fill whole rows of a texture. */
function tailArray(capacity: number, length: number): Float32Array {
  const row = 256 * kTailPoint;
  return new Float32Array(Math.ceil((capacity * (length + 1) * kTailPoint) / row) * row);
}

export class Fleet {
  /** Rows of `columns.width` numbers, as the last frame had them. */
  rows: Float64Array;
  /** Rows of kMotion floats, for the graphics card; times are relative to `epoch`. */
  motion: Float32Array;
  ids: Int32Array;
  count = 0;
  /** Counts frames: whoever draws compares it with the last that was drawn. */
  version = 0;
  time = 0;
  /** Times on the graphics card are relative to this [s]: single floats cannot hold hours in milliseconds. */
  epoch = 0;
  readonly columns: Columns;
  readonly column: Record<string, number> = {};
  private readonly rowOf = new Map<number, number>();
  private capacity = 64;
  private scratch: Float64Array;
  /** Called for each new aircraft. */
  onNew: (id: number, row: number) => void = () => undefined;
  onFrame: (time: number) => void = () => undefined;
  groundAt: (north: number, east: number) => number = () => 0;

  // Numbers of colours: eight for few aircraft, one for many, one for failsafes.
  warnedTint = 8;
  plainTint = 9;

  /** Frames that are farther apart say nothing of the time between them [s]. */
  gap = 5;
  /** All of the way, for those who want to see it. */
  readonly tracks: Tracks | null;

  // Tails: of each aircraft a ring of places, its first repeated at the end.
  tailLength = kTails[0][1];
  tails: Float32Array;
  tailHead: Int32Array;
  tailVersion = 0;
  private tailEvery = 1; // [s] of simulated time

  constructor(
    decoder: Decoder,
    kind: string,
    frameStruct: string,
    table: { structs: Record<string, [string, string, ...unknown[]][]> },
    private readonly frame: Frame,
    withTails = true,
  ) {
    const list = table.structs[frameStruct].find(([, type]) => type.endsWith("[]"))!;
    this.columns = decoder.columns(list[1].slice(1, -2));
    this.columns.names.forEach((name, k) => {
      this.column[name] = k;
    });
    if (!withTails) this.tailLength = 0;
    this.tracks = withTails ? new Tracks() : null;
    this.rows = new Float64Array(this.capacity * this.columns.width);
    this.scratch = new Float64Array(this.columns.width);
    this.motion = new Float32Array(this.capacity * kMotion);
    this.ids = new Int32Array(this.capacity);
    this.tails = tailArray(this.capacity, this.tailLength);
    this.tailHead = new Int32Array(this.capacity).fill(-1);
    decoder.take(kind, (reader) => this.read(reader));
  }

  clear(): void {
    this.count = 0;
    this.rowOf.clear();
    this.tails.fill(0);
    this.tailHead.fill(-1);
    this.tracks?.clear();
    this.version++;
    this.tailVersion++;
  }

  row(id: number): number {
    return this.rowOf.get(id) ?? -1;
  }

  /** A number of the last frame; NaN where it says none. */
  get(row: number, name: string): number {
    const column = this.column[name];
    return column === undefined ? NaN : this.rows[row * this.columns.width + column];
  }

  /** A word of an enumeration. */
  word(row: number, name: string): string {
    const column = this.column[name];
    return column === undefined ? "" : (this.columns.words[column]?.[this.rows[row * this.columns.width + column]] ?? "");
  }

  private grow(): void {
    this.capacity *= 2;
    const copy = <A extends Float32Array | Float64Array | Int32Array>(to: A, from: A): A => {
      to.set(from as never);
      return to;
    };
    this.rows = copy(new Float64Array(this.capacity * this.columns.width), this.rows);
    this.motion = copy(new Float32Array(this.capacity * kMotion), this.motion);
    this.ids = copy(new Int32Array(this.capacity), this.ids);
    this.setTailLength(this.tailLength, true);
  }

  /** Many aircraft have short tails. */
  private setTailLength(length: number, keep: boolean): void {
    const tails = tailArray(this.capacity, length),
      heads = new Int32Array(this.capacity).fill(-1);
    if (keep && length === this.tailLength) {
      tails.set(this.tails);
      heads.set(this.tailHead);
    }
    this.tails = tails;
    this.tailHead = heads;
    this.tailLength = length;
  }

  private add(id: number): number {
    if (this.count === this.capacity) this.grow();
    const row = this.count++;
    this.rowOf.set(id, row);
    this.ids[row] = id;
    this.motion.fill(0, row * kMotion, (row + 1) * kMotion);
    if (this.tailLength > 0) {
      const length = kTails.find(([upTo]) => this.count <= upTo)![1];
      if (length < this.tailLength) this.setTailLength(length, false);
    }
    this.onNew(id, row);
    return row;
  }

  private read(r: Reader): void {
    const length = r.uint(),
      end = r.at + length;
    const time = r.time();
    if (time < this.time - 1e-6) this.restart();
    if (this.version === 0 || Math.abs(time - this.epoch) > 3600) this.moveEpoch(time);
    this.time = time;
    const { width } = this.columns,
      idColumn = this.column.entity_id;
    for (let left = r.uint(); left > 0; --left) {
      this.columns.read(r, this.scratch, 0);
      const id = this.scratch[idColumn];
      const known = this.rowOf.get(id);
      const row = known === undefined ? this.add(id) : known;
      this.rows.set(this.scratch, row * width);
      this.move(row, time, known === undefined);
    }
    r.at = end;
    this.version++;
    this.onFrame(time);
  }

  // Time has gone back: a replay was moved, or the run started again.
  private restart(): void {
    this.tails.fill(0);
    this.tailHead.fill(-1);
    this.tailVersion++;
    this.tracks?.clear();
    for (let row = 0; row < this.count; ++row) this.motion[row * kMotion + kNow + 3] = -1e9;
  }

  private moveEpoch(time: number): void {
    const shift = this.epoch - time;
    this.epoch = time;
    for (let row = 0; row < this.count; ++row) {
      this.motion[row * kMotion + kBefore + 3] += shift;
      this.motion[row * kMotion + kNow + 3] += shift;
      this.motion[row * kMotion + kHeard] += shift;
    }
    for (let i = 3; i < this.tails.length; i += kTailPoint) this.tails[i] += shift;
  }

  private move(row: number, time: number, fresh: boolean): void {
    const m = this.motion,
      at = row * kMotion,
      { column, rows } = this,
      from = row * this.columns.width;
    const north = rows[from + column.north_m],
      east = rows[from + column.east_m];
    const jumped = fresh || time - this.epoch - m[at + kNow + 3] > this.gap;
    if (!jumped) {
      m.copyWithin(at + kBefore, at + kNow, at + kNow + 4);
      m[at + kHeadings] = m[at + kHeadings + 1];
    }
    this.frame.toPlane(north, east, m, at + kNow);
    m[at + kNow + 2] = rows[from + column.altitude_msl_m];
    m[at + kNow + 3] = time - this.epoch;
    m[at + kHeadings + 1] = (rows[from + column.heading_deg] * Math.PI) / 180;
    if (jumped) {
      m.copyWithin(at + kBefore, at + kNow, at + kNow + 4);
      m[at + kHeadings] = m[at + kHeadings + 1];
    }
    const heard = rows[from + column.heard_s],
      age = rows[from + column.age_s];
    m[at + kHeard] = (heard === heard ? Math.min(heard, time - (age || 0)) : time - (age || 0)) - this.epoch;
    m[at + kTint] = rows[from + column.failsafe] > 0 ? this.warnedTint : this.count <= 8 ? row % 8 : this.plainTint;
    this.tracks?.add(this.ids[row], m[at + kNow], m[at + kNow + 1], m[at + kNow + 2], time);
    if (this.tailLength > 0) this.trail(row, jumped && !fresh);
  }

  private trail(row: number, broken: boolean): void {
    const n = this.tailLength,
      base = row * (n + 1) * kTailPoint,
      m = this.motion,
      at = row * kMotion + kNow;
    let head = this.tailHead[row];
    if (broken) {
      this.tails.fill(0, base, base + (n + 1) * kTailPoint);
      head = -1;
    }
    if (head >= 0 && m[at + 3] - this.tails[base + head * kTailPoint + 3] < this.tailEvery) return;
    if (head < 0) this.motion[row * kMotion + kGround] = this.groundAt(this.get(row, "north_m"), this.get(row, "east_m"));
    head = (head + 1) % n;
    // A place that was never written is far in the past: its segments are not drawn.
    if (head === 0 && this.tailHead[row] < 0) for (let k = 0; k <= n; ++k) this.tails[base + k * kTailPoint + 3] = -1e9;
    for (let k = 0; k < 4; ++k) this.tails[base + head * kTailPoint + k] = m[at + k];
    if (head === 0) for (let k = 0; k < 4; ++k) this.tails[base + n * kTailPoint + k] = m[at + k];
    this.tailHead[row] = head;
    this.motion[row * kMotion + kGround] = this.groundAt(this.get(row, "north_m"), this.get(row, "east_m"));
    this.tailVersion++;
  }

  /**
   * Where an aircraft is drawn at a time: x, y, altitude, heading [rad] into `out`. Between the last
   * two frames, and at most a second beyond.
   */
  pose(row: number, time: number, out: Float64Array): void {
    const m = this.motion,
      at = row * kMotion,
      t = time - this.epoch;
    const t0 = m[at + kBefore + 3],
      t1 = m[at + kNow + 3],
      span = t1 - t0;
    const f = span > 1e-4 ? Math.max(0, (Math.min(t, t1 + 1) - t0) / span) : 1;
    for (let k = 0; k < 3; ++k) out[k] = m[at + kBefore + k] + f * (m[at + kNow + k] - m[at + kBefore + k]);
    let turn = m[at + kHeadings + 1] - m[at + kHeadings];
    turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
    out[3] = m[at + kHeadings] + Math.min(f, 1.5) * turn;
  }
}

/** The simulated time that is drawn. */
export interface ShownTime {
  now(wall: number): number;
}

/**
 * The same of a run that goes on elsewhere: it runs smoothly behind the newest frame by as long as frames
 * are apart, so that there is always one to go toward.
 */
export class PlayTime implements ShownTime {
  private anchor = 0;
  private anchorWall = 0;
  private newest = 0;
  private newestWall = 0;
  private gap = 0.1; // between frames, simulated [s]
  private rate = 1; // simulated over wall time
  private begun = false;
  paused = false;

  /** A frame of this time has come. */
  frame(time: number, wall: number): void {
    const dt = time - this.newest,
      dw = wall - this.newestWall;
    if (!this.begun || dt < 0 || dt > Math.max(30, 20 * this.gap)) {
      this.begun = true;
      this.newest = this.anchor = time;
      this.newestWall = this.anchorWall = wall;
      return;
    }
    if (dt === 0) return;
    if (dw > 0.005) {
      this.gap += 0.1 * (Math.min(dt, 10) - this.gap);
      this.rate += 0.1 * (Math.min(dt / dw, 1000) - this.rate);
    }
    const shown = this.now(wall);
    this.newest = time;
    this.newestWall = wall;
    const off = time - this.gap - shown;
    this.anchor = Math.abs(off) > 4 * this.gap + 0.5 * this.rate ? time - this.gap : shown + 0.15 * off;
    this.anchorWall = wall;
  }

  now(wall: number): number {
    if (this.paused) return this.newest;
    const shown = this.anchor + this.rate * Math.max(0, wall - this.anchorWall);
    return Math.min(shown, this.newest + 1);
  }
}
