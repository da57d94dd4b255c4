// SPDX-License-Identifier: Apache-2.0
/** What a pilot would see at one time, as on a traffic display: own ship in the middle, nose up, range rings, others by
 * relative altitude and alert, bands of tracks round the compass, of speeds, altitudes and vertical speeds on tapes. */
import { kRegions, type Region } from "./alerts";
import type { BandList, BandRow } from "./data";
import type { Cockpit, OwnShip } from "./cockpit";

/** As on displays in cockpits: dark, whatever the page is. */
const kInk = {
  ground: "#0b0e11",
  ring: "#46525c",
  ink: "#e8eaec",
  muted: "#8b98a3",
  own: "#ffffff",
  other: "#7fd4ff",
  team: "#b8c4ff",
  preventive: "#f0e070",
  corrective: "#ffab1a",
  warning: "#ff3b30",
  recovery: "#35d07f",
  path: "#ff7bf5",
  box: "#1b2229",
};
const kRegionInk: Record<Region, string> = { NONE: kInk.ink, FAR: kInk.preventive, MID: kInk.corrective, NEAR: kInk.warning, RECOVERY: kInk.recovery };
const kDegree = Math.PI / 180;
const kNear = 11000,
  kNearHeight = 366; // proximate traffic: 6 NM, 1200 ft [m]
const kClimbs = 2.5; // an arrow says so [m/s]
const kTape = 62,
  kClimbTape = 54,
  kGap = 12; // widths [px]

/** The range that shows who is alerted, else who is near [m]. */
export function fittingRange(cockpit: Cockpit, own: OwnShip, time: number): number {
  const distances = cockpit
    .traffic(time)
    .map((each) => ({
      distance: Math.hypot(each.north - own.pose.north, each.east - own.pose.east),
      alert: cockpit.alerts.alert(cockpit.aircraft, each.track, time),
    }));
  const alerted = distances.filter(({ alert }) => alert).map(({ distance }) => distance);
  const far = alerted.length > 0 ? Math.max(...alerted) : Math.min(7000, ...distances.map(({ distance }) => distance));
  return kRanges.find((range) => range >= 1.1 * far) ?? kRanges[kRanges.length - 1];
}
export const kRanges = [500, 1000, 2000, 4000, 8000, 16000, 32000];

type Context = CanvasRenderingContext2D;

function text(c: Context, what: string, x: number, y: number, colour: string, align: CanvasTextAlign = "center", size = 12): void {
  c.font = `${size}px system-ui, sans-serif`;
  c.textAlign = align;
  c.textBaseline = "middle";
  c.fillStyle = colour;
  c.fillText(what, x, y);
}

function pieces(list: BandList): { from: number; to: number; region: Region }[] {
  const all = [];
  for (let i = 0; i + 2 < list.length; i += 3) all.push({ from: list[i], to: list[i + 1], region: kRegions[list[i + 2]] ?? "NONE" });
  return all;
}

/** The compass: ticks, letters, and the bands of tracks as arcs; angles from the nose. */
function drawCompass(c: Context, x: number, y: number, radius: number, own: OwnShip, bands: BandRow | null): void {
  const angle = (bearing: number) => bearing - own.pose.heading - Math.PI / 2;
  c.strokeStyle = kInk.muted;
  c.lineWidth = 1.2;
  c.beginPath();
  c.arc(x, y, radius, 0, 7);
  c.stroke();
  for (let degrees = 0; degrees < 360; degrees += 10) {
    const a = angle(degrees * kDegree),
      long = degrees % 30 === 0;
    c.beginPath();
    c.moveTo(x + radius * Math.cos(a), y + radius * Math.sin(a));
    c.lineTo(x + (radius - (long ? 11 : 6)) * Math.cos(a), y + (radius - (long ? 11 : 6)) * Math.sin(a));
    c.stroke();
    if (!long) continue;
    const name = { 0: "N", 90: "E", 180: "S", 270: "W" }[degrees] ?? String(degrees / 10);
    text(c, name, x + (radius - 21) * Math.cos(a), y + (radius - 21) * Math.sin(a), kInk.ink, "center", 13);
  }
  if (bands) {
    for (const { from, to, region } of pieces(bands[6])) {
      if (region === "NONE") continue;
      c.strokeStyle = kRegionInk[region];
      c.lineWidth = 7;
      c.setLineDash(region === "RECOVERY" ? [9, 6] : []);
      c.beginPath();
      c.arc(x, y, radius + 5, angle(from * kDegree), angle(to * kDegree));
      c.stroke();
    }
    c.setLineDash([]);
    if (bands[2] !== null) bug(c, x, y, radius, angle(bands[2] * kDegree), kInk.recovery, true);
  }
  bug(c, x, y, radius, angle(own.track), kInk.own, false);
}

/** A mark at the compass: what is flown, hollow; what is advised, filled. */
function bug(c: Context, x: number, y: number, radius: number, a: number, colour: string, filled: boolean): void {
  c.save();
  c.translate(x + radius * Math.cos(a), y + radius * Math.sin(a));
  c.rotate(a + Math.PI / 2);
  c.beginPath();
  c.moveTo(0, 2);
  c.lineTo(7, -10);
  c.lineTo(-7, -10);
  c.closePath();
  c.lineWidth = 1.6;
  c.strokeStyle = c.fillStyle = colour;
  if (filled) c.fill();
  c.stroke();
  c.restore();
}

function drawOwn(c: Context, x: number, y: number): void {
  c.strokeStyle = kInk.own;
  c.lineWidth = 2.4;
  c.lineCap = "round";
  c.beginPath();
  c.moveTo(x, y - 10);
  c.lineTo(x, y + 9);
  c.moveTo(x - 11, y - 1);
  c.lineTo(x + 11, y - 1);
  c.moveTo(x - 5, y + 8);
  c.lineTo(x + 5, y + 8);
  c.stroke();
  c.lineCap = "butt";
}

type Symbol = "other" | "near" | "corrective" | "warning" | "preventive";

/** Diamond, filled diamond, amber circle, red square: as traffic displays have them. */
function drawSymbol(c: Context, x: number, y: number, symbol: Symbol): void {
  c.beginPath();
  if (symbol === "warning") {
    c.rect(x - 7, y - 7, 14, 14);
  } else if (symbol === "corrective") {
    c.arc(x, y, 8, 0, 7);
  } else {
    c.moveTo(x, y - 8);
    c.lineTo(x + 8, y);
    c.lineTo(x, y + 8);
    c.lineTo(x - 8, y);
    c.closePath();
  }
  c.lineWidth = 1.8;
  c.strokeStyle = c.fillStyle =
    symbol === "warning" ? kInk.warning : symbol === "corrective" ? kInk.corrective : symbol === "preventive" ? kInk.preventive : kInk.other;
  if (symbol !== "other") c.fill();
  c.stroke();
}

const signed = (value: number) => `${value < 0 ? "−" : "+"}${Math.abs(Math.round(value))}`;

function drawOthers(c: Context, x: number, y: number, radius: number, range: number, cockpit: Cockpit, own: OwnShip, time: number): void {
  const scale = radius / range;
  const place = (north: number, east: number): [number, number] => {
    const n = north - own.pose.north,
      e = east - own.pose.east,
      h = own.pose.heading;
    return [x + (-n * Math.sin(h) + e * Math.cos(h)) * scale, y - (n * Math.cos(h) + e * Math.sin(h)) * scale];
  };
  const recommended = cockpit.alerts.recommendation(cockpit.aircraft, time);
  c.save();
  c.beginPath();
  c.arc(x, y, radius, 0, 7);
  c.clip();
  if (recommended) {
    c.strokeStyle = kInk.path;
    c.lineWidth = 2.4;
    c.setLineDash(recommended.state === "followed" ? [] : [8, 5]);
    c.beginPath();
    recommended.path
      .filter((point) => point.time_s >= time)
      .forEach((point, i) => {
        const [px, py] = place(point.north_m, point.east_m);
        if (i === 0) c.moveTo(px, py);
        else c.lineTo(px, py);
      });
    c.stroke();
    c.setLineDash([]);
  }
  cockpit.team(time).forEach(({ name, pose }, index) => {
    const [px, py] = place(pose.north, pose.east);
    c.save();
    c.translate(px, py);
    c.rotate(pose.heading - own.pose.heading);
    c.strokeStyle = kInk.team;
    c.lineWidth = 1.8;
    c.beginPath();
    c.moveTo(-6, 5);
    c.lineTo(0, -6);
    c.lineTo(6, 5);
    c.stroke();
    c.restore();
    // Neighbours in a row do not write over each other.
    text(c, `${name} ${signed(pose.altitude - own.pose.altitude)}`, px, index % 2 === 0 ? py + 16 : py - 16, kInk.team, "center", 11);
  });
  const all = cockpit
    .traffic(time)
    .map((each) => ({ each, alert: cockpit.alerts.alert(cockpit.aircraft, each.track, time) }))
    .sort((a, b) => (a.alert?.level ?? 0) - (b.alert?.level ?? 0)); // the highest on top
  for (const { each, alert } of all) {
    const [px, py] = place(each.north, each.east);
    const height = each.altitude - own.pose.altitude;
    const near = Math.hypot(each.north - own.pose.north, each.east - own.pose.east) < kNear && Math.abs(height) < kNearHeight;
    const symbol: Symbol = !alert ? (near ? "near" : "other") : alert.region === "NEAR" ? "warning" : alert.region === "MID" ? "corrective" : "preventive";
    // Where it is believed to be, as an area; where it will be in half a minute.
    c.globalAlpha = 0.5;
    c.lineWidth = 1;
    c.strokeStyle = alert ? kInk.corrective : kInk.other;
    c.beginPath();
    c.arc(px, py, Math.max(1, 2 * each.deviation * scale), 0, 7);
    c.stroke();
    c.globalAlpha = 1;
    c.beginPath();
    c.moveTo(px, py);
    c.lineTo(...place(each.north + 30 * each.velocity[0], each.east + 30 * each.velocity[1]));
    c.stroke();
    drawSymbol(c, px, py, symbol);
    const colour = c.fillStyle as string;
    const arrow = each.velocity[2] > kClimbs ? "↑" : each.velocity[2] < -kClimbs ? "↓" : "";
    text(c, `${signed(height)}${arrow}`, px, height >= 0 ? py - 17 : py + 17, colour, "center", 12);
  }
  c.restore();
}

interface Tape {
  x: number; // left end
  width: number;
  span: number; // of the values shown [m/s, m]
  step: number;
  value: number;
  bands: BandList;
  advised: number | null;
  title: string;
  digits: number;
  fixed: boolean; // zero in the middle, a pointer moves; else the value is in the middle
  right: boolean; // bands at the right edge
}

function drawTape(c: Context, y: number, height: number, tape: Tape): void {
  const { x, width, span, value } = tape;
  const centre = tape.fixed ? 0 : value;
  const at = (v: number) => y + height / 2 - ((v - centre) / span) * height;
  const edge = tape.right ? x + width : x,
    inner = tape.right ? -1 : 1;
  text(c, tape.title, x + width / 2, y - 12, kInk.muted, "center", 11);
  c.save();
  c.beginPath();
  c.rect(x - 1, y, width + 2, height);
  c.clip();
  c.fillStyle = kInk.box;
  c.fillRect(x, y, width, height);
  for (const { from, to, region } of pieces(tape.bands)) {
    if (region === "NONE") continue;
    c.strokeStyle = kRegionInk[region];
    c.lineWidth = 7;
    c.setLineDash(region === "RECOVERY" ? [9, 6] : []);
    c.beginPath();
    c.moveTo(edge + inner * 4, at(from));
    c.lineTo(edge + inner * 4, at(to));
    c.stroke();
  }
  c.setLineDash([]);
  c.strokeStyle = kInk.ring;
  c.lineWidth = 1;
  const first = Math.ceil((centre - span / 2) / tape.step) * tape.step;
  for (let v = first; v <= centre + span / 2; v += tape.step) {
    c.beginPath();
    c.moveTo(edge + inner * 8, at(v));
    c.lineTo(edge + inner * 14, at(v));
    c.stroke();
    text(c, v.toFixed(tape.step < 1 ? 1 : 0).replace("-", "−"), edge + inner * 18, at(v), kInk.muted, tape.right ? "right" : "left", 11);
  }
  if (tape.advised !== null) {
    const py = Math.min(Math.max(at(tape.advised), y + 6), y + height - 6);
    c.fillStyle = kInk.recovery;
    c.beginPath();
    c.moveTo(edge, py);
    c.lineTo(edge + inner * 13, py - 6);
    c.lineTo(edge + inner * 13, py + 6);
    c.closePath();
    c.fill();
  }
  const py = Math.min(Math.max(at(value), y + 10), y + height - 10);
  c.fillStyle = kInk.ground;
  c.strokeStyle = kInk.ink;
  const bx = tape.right ? x + 2 : x + 12,
    bw = width - 14;
  c.fillRect(bx, py - 10, bw, 20);
  c.strokeRect(bx + 0.5, py - 9.5, bw - 1, 19);
  text(c, value.toFixed(tape.digits).replace("-", "−"), bx + bw / 2, py, kInk.ink, "center", 13);
  c.restore();
}

/** Draws the display of an aircraft; the context's units are CSS pixels. */
export function drawPilotDisplay(c: Context, cockpit: Cockpit, time: number, range: number, width: number, height: number): void {
  c.fillStyle = kInk.ground;
  c.fillRect(0, 0, width, height);
  const own = cockpit.own(time);
  if (!own) {
    text(c, `${cockpit.name} does not fly at this time`, width / 2, height / 2, kInk.muted, "center", 14);
    return;
  }
  const bands = cockpit.alerts.bands(cockpit.aircraft, time);
  const left = kGap + kTape + kGap,
    right = kGap + kTape + kGap + kClimbTape + kGap;
  const radius = Math.max(60, Math.min((width - left - right) / 2 - 14, height / 2 - 42));
  const x = left + (width - left - right) / 2,
    y = height / 2 + 14;

  for (const part of [0.5, 1]) {
    c.strokeStyle = kInk.ring;
    c.lineWidth = 1;
    c.setLineDash(part < 1 ? [3, 5] : []);
    c.beginPath();
    c.arc(x, y, part * radius, 0, 7);
    c.stroke();
    c.setLineDash([]);
  }
  const rangeText = (metres: number) => (metres < 1000 ? `${metres} m` : `${metres / 1000} km`);
  drawOthers(c, x, y, radius, range, cockpit, own, time);
  text(c, rangeText(range / 2), x + 0.5 * radius * 0.71 + 6, y + 0.5 * radius * 0.71 + 6, kInk.muted, "left", 11);
  drawCompass(c, x, y, radius, own, bands);
  drawOwn(c, x, y);
  const heading = Math.round((((own.pose.heading / kDegree) % 360) + 360) % 360) % 360;
  c.fillStyle = kInk.box;
  c.fillRect(x - 24, y - radius - 38, 48, 20);
  text(c, String(heading).padStart(3, "0"), x, y - radius - 28, kInk.ink, "center", 14);
  text(c, `${cockpit.name} · range ${rangeText(range)}`, x - radius, 14, kInk.muted, "left", 11);

  const tapeHeight = 2 * radius * 0.86,
    tapeTop = y - tapeHeight / 2;
  drawTape(c, tapeTop, tapeHeight, {
    x: kGap,
    width: kTape,
    span: 40,
    step: 5,
    value: own.speed,
    bands: bands?.[7] ?? [],
    advised: bands?.[3] ?? null,
    title: "speed m/s",
    digits: 1,
    fixed: false,
    right: true,
  });
  drawTape(c, tapeTop, tapeHeight, {
    x: width - right + kGap,
    width: kTape,
    span: 400,
    step: 50,
    value: own.pose.altitude,
    bands: bands?.[9] ?? [],
    advised: null,
    title: "altitude m",
    digits: 0,
    fixed: false,
    right: false,
  });
  const climbs = Math.max(
    6,
    Math.abs(own.climb) + 1,
    Math.abs(bands?.[4] ?? 0) + 1,
    ...pieces(bands?.[8] ?? [])
      .filter(({ region }) => region !== "NONE")
      .flatMap(({ from, to }) => [Math.abs(from), Math.abs(to)]),
  );
  drawTape(c, tapeTop, tapeHeight, {
    x: width - kGap - kClimbTape,
    width: kClimbTape,
    span: 2 * climbs,
    step: climbs > 20 ? 10 : climbs > 12 ? 5 : 2,
    value: own.climb,
    bands: bands?.[8] ?? [],
    advised: bands?.[4] ?? null,
    title: "climb m/s",
    digits: 1,
    fixed: true,
    right: false,
  });
}
