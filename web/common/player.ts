// SPDX-License-Identifier: Apache-2.0
/** Moves through the time of recordings: plays, stands still, goes anywhere. */
import type { ShownTime } from "./fleet";

export class Player implements ShownTime {
  time = 0;
  playing = false;
  speed = 60; // recorded over wall time
  /** Are told of every other time, and of play and pause. */
  readonly listeners: ((time: number) => void)[] = [];
  private last = 0;

  /** @param end  of the longest recording [s] */
  constructor(readonly end: number) {}

  /** What is drawn is of exactly this time. */
  now(): number {
    return this.time;
  }

  /** From the end it begins anew. */
  play(): void {
    if (this.playing) return;
    if (this.time >= this.end) this.time = 0;
    this.playing = true;
    this.last = performance.now();
    requestAnimationFrame((now) => this.tick(now));
    this.tell();
  }

  pause(): void {
    this.playing = false;
    this.tell();
  }

  seek(seconds: number): void {
    this.time = Math.min(Math.max(seconds, 0), this.end);
    this.tell();
  }

  /** Stands still at a time. */
  stand(seconds: number): void {
    this.playing = false;
    this.seek(seconds);
  }

  private tick(now: number): void {
    if (!this.playing) return;
    // A hidden page gets no frames: do not jump when it comes back.
    const passed = Math.min(Math.max(now - this.last, 0), 200) / 1000;
    this.last = now;
    const next = this.time + passed * this.speed;
    if (next >= this.end) this.playing = false;
    else requestAnimationFrame((later) => this.tick(later));
    this.seek(next);
  }

  private tell(): void {
    for (const listener of this.listeners) listener(this.time);
  }
}
