// SPDX-License-Identifier: Apache-2.0
/** From the plane of the map to pixels, with the camera that the map was drawn with last. */

export class Projector {
  /** Takes metres of the plane (x east, y south) and of height to clip space; column by column. */
  readonly matrix = new Float64Array(16);
  readonly matrix32 = new Float32Array(16);
  width = 1; // [CSS px]
  height = 1;
  /** Counts cameras. */
  version = 0;
  /** In 2D everything lies on the plane. */
  flat = true;
  /** Pixels per metre in the middle. */
  scale = 1;
  bearing = 0; // [rad]
  pitch = 0;
  // The last place that was projected.
  x = 0;
  y = 0;

  /** The camera from now on: a matrix for Mercator units, and where the plane's origin is in them. */
  set(mercator: ArrayLike<number>, originX: number, originY: number, perMetre: number): void {
    const m = this.matrix;
    let changed = false;
    for (let row = 0; row < 4; ++row) {
      const translated = mercator[row] * originX + mercator[4 + row] * originY + mercator[12 + row];
      const values = [mercator[row] * perMetre, mercator[4 + row] * perMetre, mercator[8 + row] * perMetre, translated];
      for (let column = 0; column < 4; ++column) {
        const at = 4 * column + row;
        if (m[at] !== values[column]) changed = true;
        m[at] = values[column];
      }
    }
    if (!changed) return;
    this.matrix32.set(m);
    this.version++;
  }

  /** Where a place is on the screen, into x and y [CSS px]; false behind the camera. */
  project(px: number, py: number, height: number): boolean {
    const m = this.matrix,
      z = this.flat ? 0 : height;
    const w = m[3] * px + m[7] * py + m[11] * z + m[15];
    if (w <= 0) return false;
    this.x = (0.5 + (0.5 * (m[0] * px + m[4] * py + m[8] * z + m[12])) / w) * this.width;
    this.y = (0.5 - (0.5 * (m[1] * px + m[5] * py + m[9] * z + m[13])) / w) * this.height;
    return true;
  }
}
