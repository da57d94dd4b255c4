// SPDX-License-Identifier: Apache-2.0
/**
 * Places: the run's local frame (north, east and altitude above the origin's ellipsoid height),
 * latitude and longitude on WGS 84, and the plane of the map (web Mercator).
 *
 * The local frame is tangent to the ellipsoid at the run's origin. Altitudes are above mean sea
 * level; the geoid is left out, as in the program.
 */

export interface Origin {
  latitude_deg: number;
  longitude_deg: number;
  height_m: number;
}

export interface LatLon {
  latitude_deg: number;
  longitude_deg: number;
}

export const kWgs84 = { a: 6378137, f: 1 / 298.257223563 };
const kE2 = kWgs84.f * (2 - kWgs84.f);
const kB = kWgs84.a * (1 - kWgs84.f);
const kRad = Math.PI / 180;

/** ECEF of a geodetic place [m]. */
function ecef(latitude: number, longitude: number, height: number): [number, number, number] {
  const s = Math.sin(latitude),
    c = Math.cos(latitude);
  const n = kWgs84.a / Math.sqrt(1 - kE2 * s * s);
  return [(n + height) * c * Math.cos(longitude), (n + height) * c * Math.sin(longitude), (n * (1 - kE2) + height) * s];
}

export class Frame {
  private readonly p0: [number, number, number];
  private readonly sinLat: number;
  private readonly cosLat: number;
  private readonly sinLon: number;
  private readonly cosLon: number;
  // Web Mercator of the origin, and its metres there.
  readonly mercatorX: number;
  readonly mercatorY: number;
  /** Mercator units of a metre at the origin. */
  readonly mercatorPerMetre: number;
  // Latitude [rad] and longitude [rad] of the last conversion: no object is made for it.
  private lat = 0;
  private lon = 0;

  constructor(readonly origin: Origin) {
    const lat = origin.latitude_deg * kRad,
      lon = origin.longitude_deg * kRad;
    this.p0 = ecef(lat, lon, origin.height_m);
    [this.sinLat, this.cosLat, this.sinLon, this.cosLon] = [Math.sin(lat), Math.cos(lat), Math.sin(lon), Math.cos(lon)];
    this.mercatorX = mercatorX(origin.longitude_deg);
    this.mercatorY = mercatorY(origin.latitude_deg);
    this.mercatorPerMetre = 1 / (2 * Math.PI * 6371008.8 * this.cosLat);
  }

  // Bowring's closed form, exact to a micrometre at these heights.
  private solve(north: number, east: number, up: number): void {
    const { sinLat, cosLat, sinLon, cosLon, p0 } = this;
    const x = p0[0] - sinLat * cosLon * north - sinLon * east + cosLat * cosLon * up;
    const y = p0[1] - sinLat * sinLon * north + cosLon * east + cosLat * sinLon * up;
    const z = p0[2] + cosLat * north + sinLat * up;
    const p = Math.hypot(x, y),
      ep2 = kE2 / (1 - kE2);
    const theta = Math.atan2(z * kWgs84.a, p * kB);
    const s = Math.sin(theta),
      c = Math.cos(theta);
    this.lat = Math.atan2(z + ep2 * kB * s * s * s, p - kE2 * kWgs84.a * c * c * c);
    this.lon = Math.atan2(y, x);
  }

  /** Latitude and longitude of a place at `altitude` [m]; without it at the origin's. */
  toLatLon(north_m: number, east_m: number, height_m = this.origin.height_m): LatLon {
    this.solve(north_m, east_m, height_m - this.origin.height_m);
    return { latitude_deg: this.lat / kRad, longitude_deg: this.lon / kRad };
  }

  /** The same as the map wants it: longitude, latitude. */
  toLngLat(north_m: number, east_m: number): [number, number] {
    this.solve(north_m, east_m, 0);
    return [this.lon / kRad, this.lat / kRad];
  }

  /** North and east of a place on the origin's height. */
  toLocal({ latitude_deg, longitude_deg }: LatLon): { north_m: number; east_m: number } {
    // The vertical there is not the frame's: the height that makes `up` zero is found by iteration.
    let h = this.origin.height_m,
      north = 0,
      east = 0;
    for (let k = 0; k < 3; ++k) {
      const p = ecef(latitude_deg * kRad, longitude_deg * kRad, h);
      const dx = p[0] - this.p0[0],
        dy = p[1] - this.p0[1],
        dz = p[2] - this.p0[2];
      const { sinLat, cosLat, sinLon, cosLon } = this;
      north = -sinLat * cosLon * dx - sinLat * sinLon * dy + cosLat * dz;
      east = -sinLon * dx + cosLon * dy;
      h -= cosLat * cosLon * dx + cosLat * sinLon * dy + sinLat * dz;
    }
    return { north_m: north, east_m: east };
  }

  /** Writes Mercator x and y relative to the origin, in its metres (x east, y south), at `out[at]`. */
  toPlane(north_m: number, east_m: number, out: Float32Array | Float64Array, at: number): void {
    this.solve(north_m, east_m, 0);
    const x = this.lon / (2 * Math.PI) + 0.5 - this.mercatorX;
    const y = 0.5 - Math.log(Math.tan(Math.PI / 4 + this.lat / 2)) / (2 * Math.PI) - this.mercatorY;
    out[at] = x / this.mercatorPerMetre;
    out[at + 1] = y / this.mercatorPerMetre;
  }
}

export function mercatorX(longitude_deg: number): number {
  return longitude_deg / 360 + 0.5;
}

export function mercatorY(latitude_deg: number): number {
  return 0.5 - Math.log(Math.tan(Math.PI / 4 + (latitude_deg * kRad) / 2)) / (2 * Math.PI);
}

export function latitudeOfMercator(y: number): number {
  return (2 * Math.atan(Math.exp((0.5 - y) * 2 * Math.PI)) - Math.PI / 2) / kRad;
}

export interface Utm {
  zone: number;
  band: string;
  easting_m: number;
  northing_m: number;
}

const kBands = "CDEFGHJKLMNPQRSTUVWX";

function utmZone(latitude_deg: number, longitude_deg: number): number {
  const zone = Math.min(60, Math.floor((longitude_deg + 180) / 6) + 1);
  if (latitude_deg >= 56 && latitude_deg < 64 && longitude_deg >= 3 && longitude_deg < 12) return 32;
  if (latitude_deg >= 72 && longitude_deg >= 0 && longitude_deg < 42) return longitude_deg < 9 ? 31 : longitude_deg < 21 ? 33 : longitude_deg < 33 ? 35 : 37;
  return zone;
}

/**
 * Universal Transverse Mercator by Krueger's series in the third flattening n, to n^4: exact to
 * 0.1 mm within a zone. Null near the poles, where UTM does not apply.
 * Reference: [Karney11] Eqs. (7) to (12), (35).
 */
export function toUtm({ latitude_deg, longitude_deg }: LatLon): Utm | null {
  if (latitude_deg < -80 || latitude_deg >= 84) return null;
  const zone = utmZone(latitude_deg, longitude_deg);
  const lambda = (longitude_deg - (zone * 6 - 183)) * kRad,
    phi = latitude_deg * kRad;
  const n = kWgs84.f / (2 - kWgs84.f),
    n2 = n * n,
    n3 = n2 * n,
    n4 = n3 * n;
  const radius = (kWgs84.a / (1 + n)) * (1 + n2 / 4 + n4 / 64);
  const alpha = [
    n / 2 - (2 * n2) / 3 + (5 * n3) / 16 + (41 * n4) / 180,
    (13 * n2) / 48 - (3 * n3) / 5 + (557 * n4) / 1440,
    (61 * n3) / 240 - (103 * n4) / 140,
    (49561 * n4) / 161280,
  ];
  const e = Math.sqrt(kE2),
    tau = Math.tan(phi),
    root = Math.hypot(1, tau);
  const sigma = Math.sinh(e * Math.atanh((e * tau) / root));
  const tauC = tau * Math.hypot(1, sigma) - sigma * root; // conformal latitude
  const xiC = Math.atan2(tauC, Math.cos(lambda));
  const etaC = Math.asinh(Math.sin(lambda) / Math.hypot(tauC, Math.cos(lambda)));
  let xi = xiC,
    eta = etaC;
  alpha.forEach((a, k) => {
    const j = 2 * (k + 1);
    xi += a * Math.sin(j * xiC) * Math.cosh(j * etaC);
    eta += a * Math.cos(j * xiC) * Math.sinh(j * etaC);
  });
  const k0 = 0.9996;
  return {
    zone,
    band: kBands[Math.min(19, Math.floor((latitude_deg + 80) / 8))],
    easting_m: 500000 + k0 * radius * eta,
    northing_m: k0 * radius * xi + (latitude_deg < 0 ? 1e7 : 0),
  };
}

/** "10S 614312 4054021": rounded down to the metre, as grid references are. */
export function utmText(place: LatLon): string {
  const utm = toUtm(place);
  return utm ? `${utm.zone}${utm.band} ${Math.floor(utm.easting_m)} ${Math.floor(utm.northing_m)}` : "–";
}

const kColumns = ["ABCDEFGH", "JKLMNPQR", "STUVWXYZ"];
const kRows = "ABCDEFGHJKLMNPQRSTUV";

/** "10S FF 14312 54021": the square of 100 km by its letters, then metres within. */
export function mgrsText(place: LatLon): string {
  const utm = toUtm(place);
  if (!utm) return "–";
  const column = kColumns[(utm.zone - 1) % 3][Math.floor(utm.easting_m / 1e5) - 1];
  const row = kRows[(Math.floor(utm.northing_m / 1e5) + (utm.zone % 2 === 0 ? 5 : 0)) % 20];
  const five = (metres: number) => String(Math.floor(metres % 1e5)).padStart(5, "0");
  return `${utm.zone}${utm.band} ${column}${row} ${five(utm.easting_m)} ${five(utm.northing_m)}`;
}

/** "36.60000° N 121.60000° W". */
export function latLonText({ latitude_deg, longitude_deg }: LatLon): string {
  const part = (value: number, plus: string, minus: string) => `${Math.abs(value).toFixed(5)}° ${value < 0 ? minus : plus}`;
  return `${part(latitude_deg, "N", "S")} ${part(longitude_deg, "E", "W")}`;
}
