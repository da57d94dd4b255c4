// SPDX-License-Identifier: Apache-2.0
/** Numbers with units, as the viewer wants them. */
import type { Settings } from "./settings";
import { T } from "./texts";

const kFoot = 0.3048,
  kKnot = 1852 / 3600,
  kMile = 1852;

export class Units {
  constructor(private readonly settings: Settings) {}

  private get aviation(): boolean {
    return this.settings.units === "aviation";
  }

  private write(value: number | null | undefined, digits: number, unit: string): string {
    return value == null || !Number.isFinite(value) ? T.none : `${value.toFixed(digits).replace("-", "−")} ${unit}`;
  }

  /** A height above mean sea level, or over ground. */
  height(metres: number | null | undefined): string {
    return this.aviation ? this.write(metres == null ? null : metres / kFoot, 0, "ft") : this.write(metres, 0, "m");
  }
  speed(mps: number | null | undefined): string {
    return this.aviation ? this.write(mps == null ? null : mps / kKnot, 0, "kt") : this.write(mps, 1, "m/s");
  }
  climb(mps: number | null | undefined): string {
    return this.aviation ? this.write(mps == null ? null : (mps / kFoot) * 60, 0, "ft/min") : this.write(mps, 1, "m/s");
  }
  /** A horizontal distance. */
  distance(metres: number | null | undefined): string {
    if (metres == null || !Number.isFinite(metres)) return T.none;
    if (this.aviation) return Math.abs(metres) >= kMile ? this.write(metres / kMile, 2, "NM") : this.write(metres / kFoot, 0, "ft");
    return Math.abs(metres) >= 10000 ? this.write(metres / 1000, 1, "km") : this.write(metres, Math.abs(metres) < 10 ? 1 : 0, "m");
  }
  angle(degrees: number | null | undefined): string {
    return degrees == null || !Number.isFinite(degrees) ? T.none : `${String(Math.round((degrees + 360) % 360) % 360).padStart(3, "0")}°`;
  }
  percent(share: number | null | undefined): string {
    return share == null || !Number.isFinite(share) ? T.none : `${Math.round(100 * share)} %`;
  }
  seconds(value: number | null | undefined): string {
    if (value == null || !Number.isFinite(value)) return T.none;
    return value < 10 ? `${value.toFixed(1)} s` : value < 120 ? `${Math.round(value)} s` : `${Math.round(value / 60)} min`;
  }
  area(squareMetres: number): string {
    return squareMetres >= 1e6 ? `${(squareMetres / 1e6).toFixed(2)} km²` : `${(squareMetres / 1e4).toFixed(1)} ha`;
  }

  /** The length of a scale bar of at most `metres`: a round number of the viewer's unit. */
  bar(metres: number): { metres: number; text: string } {
    const unit = !this.aviation ? (metres >= 1000 ? 1000 : 1) : metres >= kMile ? kMile : kFoot;
    const name = !this.aviation ? (unit === 1 ? "m" : "km") : unit === kMile ? "NM" : "ft";
    const value = metres / unit,
      power = Math.pow(10, Math.floor(Math.log10(value)));
    const round = [5, 2, 1].find((k) => k * power <= value)! * power;
    return { metres: round * unit, text: `${round} ${name}` };
  }
}
