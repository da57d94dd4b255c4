// SPDX-License-Identifier: Apache-2.0
/** The way that each aircraft has come since it was first seen, in a bounded number of points. */
const kMost = 2000; // points of an aircraft
const kPoint = 3; // x, y, altitude

export interface Track {
  /** Places in the plane of the map, as the last frame had them; the first `count` are meant. */
  points: Float64Array;
  count: number;
  every: number; // between points [s]
  last: number; // time of the last point [s]
}

export class Tracks {
  readonly all = new Map<number, Track>();

  clear(): void {
    this.all.clear();
  }

  add(id: number, x: number, y: number, altitude: number, time: number): void {
    let track = this.all.get(id);
    if (!track) this.all.set(id, (track = { points: new Float64Array(64 * kPoint), count: 0, every: 1, last: -Infinity }));
    // The end goes with the aircraft: the last point is replaced until it is far enough from the one before.
    const isNew = time - track.last >= track.every || track.count < 2;
    if (isNew) this.extend(track);
    track.points.set([x, y, altitude], (track.count - 1) * kPoint);
    if (isNew) track.last = time;
  }

  private extend(track: Track): void {
    if (track.count === kMost) {
      // Every second point goes.
      for (let i = 0; i < kMost / 2; ++i) track.points.copyWithin(i * kPoint, 2 * i * kPoint, (2 * i + 1) * kPoint);
      track.count = kMost / 2;
      track.every *= 2;
    }
    if ((track.count + 1) * kPoint > track.points.length) {
      const more = new Float64Array(2 * track.points.length);
      more.set(track.points);
      track.points = more;
    }
    ++track.count;
  }
}
