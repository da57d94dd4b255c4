// SPDX-License-Identifier: Apache-2.0
/** The ground: heights of /api/terrain, as tiles for the map and for whoever asks how high it is. */
import { addProtocol, removeProtocol } from "maplibre-gl";
import { latitudeOfMercator, type Frame } from "../frames";

const kTile = 256;

export class Terrain {
  private static count = 0;
  // A page may have several maps.
  private readonly protocol = `terrain${++Terrain.count}`;
  readonly low: number;
  readonly high: number;

  private constructor(
    private readonly frame: Frame,
    readonly rows: number,
    readonly columns: number,
    readonly south: number,
    readonly west: number,
    readonly spacing: number,
    readonly heights: Float32Array,
  ) {
    let low = Infinity,
      high = -Infinity;
    for (const height of heights) {
      low = Math.min(low, height);
      high = Math.max(high, height);
    }
    this.low = low;
    this.high = high;
  }

  /** The heights; null where the run has none. */
  static async load(url: string, frame: Frame): Promise<Terrain | null> {
    const response = await fetch(url);
    if (!response.ok) return null;
    return Terrain.read(await response.arrayBuffer(), frame);
  }

  /** The same of an answer that is there already. */
  static read(buffer: ArrayBuffer, frame: Frame): Terrain | null {
    if (buffer.byteLength < 32) return null;
    const view = new DataView(buffer);
    const rows = view.getUint32(0, true),
      columns = view.getUint32(4, true);
    if (rows < 2 || columns < 2 || buffer.byteLength < 32 + 4 * rows * columns) return null;
    return new Terrain(
      frame,
      rows,
      columns,
      view.getFloat64(8, true),
      view.getFloat64(16, true),
      view.getFloat64(24, true),
      new Float32Array(buffer, 32, rows * columns),
    );
  }

  /** Height of the ground above mean sea level [m]; beyond the edge that of the edge. */
  at(north: number, east: number): number {
    const r = Math.min(Math.max((north - this.south) / this.spacing, 0), this.rows - 1.001);
    const c = Math.min(Math.max((east - this.west) / this.spacing, 0), this.columns - 1.001);
    const i = Math.floor(r),
      j = Math.floor(c),
      fr = r - i,
      fc = c - j,
      k = i * this.columns + j,
      h = this.heights;
    return (1 - fr) * ((1 - fc) * h[k] + fc * h[k + 1]) + fr * ((1 - fc) * h[k + this.columns] + fc * h[k + this.columns + 1]);
  }

  /** West, south, east and north end [deg]. */
  bounds(): [number, number, number, number] {
    const north = this.south + (this.rows - 1) * this.spacing,
      east = this.west + (this.columns - 1) * this.spacing;
    const [w, s] = this.frame.toLngLat(this.south, this.west),
      [e, n] = this.frame.toLngLat(north, east);
    return [w, s, e, n];
  }

  /** The zoom at which a tile's pixel is about as wide as the heights are apart. */
  maxZoom(): number {
    const metres = (40075016.7 * Math.cos((this.frame.origin.latitude_deg * Math.PI) / 180)) / kTile;
    return Math.min(16, Math.max(8, Math.ceil(Math.log2(metres / this.spacing))));
  }

  /** The address of tiles. */
  get tiles(): string {
    return `${this.protocol}://{z}/{x}/{y}`;
  }

  /** Serves tiles of heights: 256 metres in red, one in green, 1/256 in blue. */
  serve(): void {
    addProtocol(this.protocol, async ({ url }) => {
      const [z, x, y] = url
        .slice(url.indexOf("://") + 3)
        .split("/")
        .map(Number);
      return { data: await createImageBitmap(this.tile(z, x, y)) };
    });
  }

  /** Serves no more. */
  forget(): void {
    removeProtocol(this.protocol);
  }

  private tile(z: number, x: number, y: number): ImageData {
    const image = new ImageData(kTile, kTile),
      size = Math.pow(2, z),
      data = image.data;
    const place = (column: number, row: number) =>
      this.frame.toLocal({ longitude_deg: ((x + column / kTile) / size - 0.5) * 360, latitude_deg: latitudeOfMercator((y + row / kTile) / size) });
    // Over a tile the frames differ by next to nothing from a bilinear map of its corners: exact
    // every 64 pixels, in between even.
    const kStep = 64,
      n = kTile / kStep;
    for (let tr = 0; tr < n; ++tr)
      for (let tc = 0; tc < n; ++tc) {
        const p = [0, 1].flatMap((dr) => [0, 1].map((dc) => place((tc + dc) * kStep, (tr + dr) * kStep)));
        for (let r = 0; r < kStep; ++r)
          for (let c = 0; c < kStep; ++c) {
            const u = (c + 0.5) / kStep,
              v = (r + 0.5) / kStep;
            const mix = (key: "north_m" | "east_m") => (1 - v) * ((1 - u) * p[0][key] + u * p[1][key]) + v * ((1 - u) * p[2][key] + u * p[3][key]);
            const height = this.at(mix("north_m"), mix("east_m")) + 32768;
            const at = 4 * ((tr * kStep + r) * kTile + tc * kStep + c),
              whole = Math.floor(height);
            data[at] = whole >> 8;
            data[at + 1] = whole & 255;
            data[at + 2] = Math.floor((height - whole) * 256);
            data[at + 3] = 255;
          }
      }
    return image;
  }
}
