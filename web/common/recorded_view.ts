// SPDX-License-Identifier: Apache-2.0
/** A recorded run on a map: nothing of it can be changed, any time of it is here. */
import { Frame } from "./frames";
import { Terrain } from "./map/terrain";
import type { Player } from "./player";
import type { RunDescription } from "./protocol";
import { Recording } from "./recording";
import { RunView } from "./view";
import { Decoder, type Table } from "./wire";
import { kTable } from "./wire_table";
import { World, type KeptEvent } from "./world";

/** What is known of a run, unpacked. */
export interface RecordedRun {
  run: RunDescription;
  step_s: number; // between frames
  terrain: ArrayBuffer;
  records: ArrayBuffer;
  frames: ArrayBuffer;
}

const kStep = 10; // of the key that steps [s]
const kUnknownOrigin = { latitude_deg: 0, longitude_deg: 0, height_m: 0 };

export class RecordedView extends RunView {
  readonly speeds = [1, 5, 10, 30, 60, 120, 300];
  readonly seeksAtOnce = true;
  readonly mayMoveTime = true;
  private readonly all: KeptEvent[];
  private readonly listener = (time: number) => this.show(time);
  private readonly recording: Recording;

  constructor(
    recorded: RecordedRun,
    private readonly player: Player,
  ) {
    const decoder = new Decoder(kTable as Table),
      frame = new Frame(recorded.run.origin ?? kUnknownOrigin);
    const world = new World(frame, decoder, kTable, { play: player, gap: recorded.step_s });
    super(recorded.run, Terrain.read(recorded.terrain, frame), world);
    this.recording = new Recording(world, decoder, recorded.records, recorded.frames);
    this.recording.show(recorded.run.duration_s);
    this.all = [...world.events];
    this.map.fieldEvery = 0.1;
    player.listeners.push(this.listener);
    this.show(player.time);
  }

  override remove(): void {
    this.player.listeners.splice(this.player.listeners.indexOf(this.listener), 1);
    super.remove();
  }

  override get end(): number {
    return Math.max(this.player.end, 1);
  }
  override get events(): readonly KeptEvent[] {
    return this.all;
  }

  pause(paused: boolean): void {
    if (paused) this.player.pause();
    else this.player.play();
  }
  step(steps: number): void {
    this.player.seek(this.player.time + kStep * steps);
  }
  speed(factor: number): void {
    this.player.speed = factor;
    this.show(this.player.time);
  }
  seek(seconds: number): void {
    this.player.seek(seconds);
  }

  private show(time_s: number): void {
    const { playing, speed, end } = this.player;
    this.recording.show(time_s);
    this.world.take("run_clock", {
      time_s,
      duration_s: end,
      speed,
      wanted_speed: speed,
      paused: !playing,
      over: !playing && time_s >= end,
      misses: 0,
      headline: "",
    });
    if (!playing) this.map.redraw();
  }
}
