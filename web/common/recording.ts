// SPDX-License-Identifier: Apache-2.0
/**
 * A run that is in the page: messages of the live feed with their times, which make the world what
 * it was at any time. As a server's replay, but all of it is here.
 */
import type { Decoder } from "./wire";
import type { World } from "./world";

interface Message {
  time: number;
  bytes: ArrayBuffer;
}

/** An item of a message, as the decoder gives it. */
type Item = [kind: string, value: unknown];

/** Messages that stand behind each other: time [s] (64-bit float), length (32-bit unsigned), bytes. */
function messages(bytes: ArrayBuffer): Message[] {
  const view = new DataView(bytes),
    all: Message[] = [];
  for (let at = 0; at < bytes.byteLength;) {
    const time = view.getFloat64(at, true),
      length = view.getUint32(at + 8, true);
    at += 12;
    if (at + length > bytes.byteLength) throw new RangeError("the recording ends too early");
    all.push({ time, bytes: bytes.slice(at, at + length) });
    at += length;
  }
  return all;
}

export class Recording {
  private readonly records: Message[];
  private readonly frames: Message[];
  // Records are decoded once: going back and forth takes no time, and shapes made of them stay.
  private readonly items: Item[][] = [];
  private recordsTaken = 0;
  private framesTaken = 0;
  private shown = -1;

  /** @param records  messages of records, @param frames  of a fleet frame and a truth frame each; in order of time */
  constructor(
    private readonly world: World,
    private readonly decoder: Decoder,
    records: ArrayBuffer,
    frames: ArrayBuffer,
  ) {
    this.records = messages(records);
    this.frames = messages(frames);
  }

  /** Makes the world what it was at a time. */
  show(time: number): void {
    if (time < this.shown || this.shown < 0) this.begin();
    this.shown = time;
    for (; this.recordsTaken < this.records.length && this.records[this.recordsTaken].time <= time; ++this.recordsTaken)
      for (const [kind, value] of this.decoded(this.recordsTaken)) this.world.take(kind, value);
    // One frame farther, so that aircraft are between two.
    while (this.framesTaken < this.frames.length && (this.framesTaken === 0 || this.frames[this.framesTaken - 1].time < time))
      this.decoder.decode(this.frames[this.framesTaken++].bytes, () => undefined);
  }

  private begin(): void {
    this.world.take("snapshot", { begins: true });
    this.world.take("snapshot", { begins: false });
    this.recordsTaken = this.framesTaken = 0;
  }

  private decoded(index: number): Item[] {
    let items = this.items[index];
    if (!items) {
      this.items[index] = items = [];
      this.decoder.decode(this.records[index].bytes, (kind, value) => items.push([kind, value]));
    }
    return items;
  }
}
