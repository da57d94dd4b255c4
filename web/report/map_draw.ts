/** Draws a scene at one time onto a canvas, north up. */
import type { Corner, Terrain } from "./data";
import { objectAt, type Ring, type Scene } from "./scene";
import { alertColour, type Theme } from "./theme";

export interface View {
  north: number; // of the middle [m]
  east: number;
  scale: number; // pixels per metre
}

export interface Layers {
  terrain: boolean;
  truth: boolean;
  belief: boolean;
  band: boolean;
  ahead: boolean;
  tracks: boolean;
  crossings: boolean;
  objects: boolean;
  traffic: boolean;
  missions: boolean;
  zones: boolean;
  names: boolean;
  tail: number; // length of the tracks [s]
}

export const kAllLayers: Layers = {
  terrain: true, truth: true, belief: true, band: true, ahead: true, tracks: true, crossings: true, objects: true,
  traffic: true,
  missions: true, zones: true,
  names: true, tail: 180,
};

const kBand95 = 1.96;
const kCrossingShown = 300; // crossings fade over this time [s]
const kDetectionShown = 300; // and detections [s]
const kBeliefShown = 1.05; // tracks of other aircraft are recorded once a second [s]
/** From so many aircraft on, the map shows less of each. */
export const kMany = 20;

type Place = (north: number, east: number) => [number, number];

/** The view that shows everything in `width` by `height` pixels. */
export function fit(scene: Scene, width: number, height: number): View {
  const { low, high } = scene.bounds();
  const spanN = Math.max(high[0] - low[0], 50), spanE = Math.max(high[1] - low[1], 50);
  return {
    north: (low[0] + high[0]) / 2,
    east: (low[1] + high[1]) / 2,
    scale: 0.88 * Math.min(width / spanE, height / spanN),
  };
}

function trace(context: CanvasRenderingContext2D, rings: Ring[], place: Place): void {
  context.beginPath();
  for (const ring of rings) {
    for (let i = 0; i < ring.north.length; ++i) {
      const [x, y] = place(ring.north[i], ring.east[i]);
      if (i === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
    context.closePath();
  }
}

/** The 95 % band: one quadrangle per edge, all turning alike so that overlaps fill once. */
function traceBand(context: CanvasRenderingContext2D, rings: Ring[], place: Place): void {
  context.beginPath();
  for (const ring of rings) {
    const { north, east, normal, sigma } = ring;
    if (!normal || !sigma) continue;
    const end = (i: number, side: number) => place(
      north[i] + side * kBand95 * sigma[i] * Math.cos(normal[i]),
      east[i] + side * kBand95 * sigma[i] * Math.sin(normal[i]));
    for (let i = 0; i < north.length; ++i) {
      const k = (i + 1) % north.length;
      const quad = [end(i, 1), end(k, 1), end(k, -1), end(i, -1)];
      let area = 0;
      for (let j = 0; j < 4; ++j) {
        const a = quad[j], b = quad[(j + 1) % 4];
        area += a[0] * b[1] - a[1] * b[0];
      }
      if (area < 0) quad.reverse();
      quad.forEach(([x, y], j) => (j === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
      context.closePath();
    }
  }
}

const reliefs = new WeakMap<Terrain, Map<boolean, HTMLCanvasElement>>();

/** The ground lit from the north-west, one pixel per grid point; made once per theme. */
function relief(terrain: Terrain, heights: Uint16Array, dark: boolean, strength: number): HTMLCanvasElement {
  let made = reliefs.get(terrain);
  if (!made) reliefs.set(terrain, (made = new Map()));
  const ready = made.get(dark);
  if (ready) return ready;
  const { rows, columns, spacing_m, step_m } = terrain;
  const canvas = document.createElement("canvas");
  canvas.width = columns;
  canvas.height = rows;
  const context = canvas.getContext("2d")!;
  const image = context.createImageData(columns, rows);
  const height = (r: number, c: number) => step_m *
    heights[Math.min(Math.max(r, 0), rows - 1) * columns + Math.min(Math.max(c, 0), columns - 1)];
  const exaggerate = 2;
  for (let r = 0; r < rows; ++r)
    for (let c = 0; c < columns; ++c) {
      const gn = (exaggerate * (height(r + 1, c) - height(r - 1, c))) / (2 * spacing_m);
      const ge = (exaggerate * (height(r, c + 1) - height(r, c - 1))) / (2 * spacing_m);
      const light = (0.5 * -gn + 0.5 * ge + 0.707) / Math.sqrt(1 + gn * gn + ge * ge);
      const shade = Math.min(1, Math.max(0, light)) - 0.707;
      const at = 4 * ((rows - 1 - r) * columns + c);
      const bright = shade > 0;
      image.data[at] = image.data[at + 1] = image.data[at + 2] = bright ? 255 : 0;
      image.data[at + 3] = 255 * Math.min(1, Math.abs(shade) * (bright ? 2.2 : 1.3)) * strength * (dark && bright ? 0.4 : 1);
    }
  context.putImageData(image, 0, 0);
  made.set(dark, canvas);
  return canvas;
}

const kNice = [1, 2, 5];
function niceStep(least: number): number {
  const power = Math.pow(10, Math.floor(Math.log10(least)));
  return (kNice.find((n) => n * power >= least) ?? 10) * power;
}

function drawGrid(context: CanvasRenderingContext2D, view: View, width: number, height: number,
  place: Place, theme: Theme): void {
  const step = niceStep(110 / view.scale);
  const n = height / 2 / view.scale, e = width / 2 / view.scale;
  context.strokeStyle = theme.grid;
  context.lineWidth = 1;
  context.beginPath();
  for (let north = Math.ceil((view.north - n) / step) * step; north <= view.north + n; north += step) {
    const y = Math.round(place(north, 0)[1]) + 0.5;
    context.moveTo(0, y);
    context.lineTo(width, y);
  }
  for (let east = Math.ceil((view.east - e) / step) * step; east <= view.east + e; east += step) {
    const x = Math.round(place(0, east)[0]) + 0.5;
    context.moveTo(x, 0);
    context.lineTo(x, height);
  }
  context.stroke();
}

function drawScale(context: CanvasRenderingContext2D, view: View, width: number, height: number, theme: Theme): void {
  const length = niceStep(60 / view.scale), pixels = length * view.scale;
  const x = 14, y = height - 16;
  context.strokeStyle = context.fillStyle = theme.ink;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + pixels, y);
  context.lineTo(x + pixels, y - 5);
  context.stroke();
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "left";
  context.fillText(length >= 1000 ? `${length / 1000} km` : `${length} m`, x + 4, y - 7);

  const cx = width - 24, cy = 34; // north arrow
  context.beginPath();
  context.moveTo(cx, cy - 14);
  context.lineTo(cx + 7, cy + 8);
  context.lineTo(cx, cy + 3);
  context.lineTo(cx - 7, cy + 8);
  context.closePath();
  context.fill();
  context.textAlign = "center";
  context.fillText("N", cx, cy + 22);
}

function label(context: CanvasRenderingContext2D, text: string, x: number, y: number, theme: Theme): void {
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "left";
  context.lineWidth = 3;
  context.strokeStyle = theme.paper;
  context.strokeText(text, x, y);
  context.fillStyle = theme.ink;
  context.fillText(text, x, y);
}

function drawTracks(context: CanvasRenderingContext2D, scene: Scene, time: number, place: Place,
  layers: Layers, theme: Theme): void {
  const many = scene.tracks.length > kMany;
  scene.tracks.forEach((track, index) => {
    const pose = scene.pose(track, time);
    const colour = theme.series[index % theme.series.length];
    const first = Math.max(0, Math.ceil((time - layers.tail - track.start) / track.step));
    const last = Math.min(track.north.length - 1, Math.floor((time - track.start) / track.step));
    if (layers.tracks && last >= first) {
      context.strokeStyle = colour;
      context.lineWidth = many ? 0.8 : 1.4;
      context.globalAlpha = many ? 0.5 : 0.85;
      context.beginPath();
      for (let i = first; i <= last; ++i) {
        const [x, y] = place(track.north[i], track.east[i]);
        if (i === first) context.moveTo(x, y);
        else context.lineTo(x, y);
      }
      if (pose) context.lineTo(...place(pose.north, pose.east));
      context.stroke();
      context.globalAlpha = 1;
    }
    if (!pose) return;
    const [x, y] = place(pose.north, pose.east), size = many ? 6 : 9;
    context.save();
    context.translate(x, y);
    context.rotate(pose.heading); // bearing 0 points up, east to the right
    context.beginPath();
    context.moveTo(0, -size);
    context.lineTo(size * 0.7, size * 0.8);
    context.lineTo(0, size * 0.35);
    context.lineTo(-size * 0.7, size * 0.8);
    context.closePath();
    context.fillStyle = colour;
    context.strokeStyle = theme.paper;
    context.lineWidth = 1.2;
    context.fill();
    context.stroke();
    context.restore();
    if (layers.names && !many) {
      label(context, track.name, x + 11, y - 6, theme);
    }
  });
}

/** Things on the ground as squares, filled once found, and where cameras placed them. */
function drawObjects(context: CanvasRenderingContext2D, scene: Scene, time: number, place: Place,
  names: boolean, theme: Theme): void {
  const { time: when, north, east, object } = scene.detections;
  const found = new Set<number>();
  context.strokeStyle = theme.found;
  context.lineWidth = 1.3;
  for (let i = 0; i < when.length && when[i] <= time + 1e-3; ++i) {
    found.add(object[i]);
    const age = time - when[i];
    if (age > kDetectionShown) continue;
    const [x, y] = place(north[i], east[i]);
    context.globalAlpha = 0.15 + 0.75 * (1 - age / kDetectionShown);
    context.beginPath();
    context.moveTo(x - 3, y - 3);
    context.lineTo(x + 3, y + 3);
    context.moveTo(x - 3, y + 3);
    context.lineTo(x + 3, y - 3);
    context.stroke();
  }
  context.globalAlpha = 1;
  for (const each of scene.objects) {
    const at = objectAt(each, time);
    if (!at) continue;
    const [x, y] = place(at[0], at[1]);
    context.fillStyle = found.has(each.object_id) ? theme.found : theme.paper;
    context.strokeStyle = theme.found;
    context.lineWidth = 1.6;
    context.fillRect(x - 4, y - 4, 8, 8);
    context.strokeRect(x - 4, y - 4, 8, 8);
    if (names && scene.objects.length <= kMany) label(context, each.name, x + 8, y + 4, theme);
  }
}

/** Other aircraft as diamonds, and circles of two deviations where firm tracks have them; both in the colour of the
 * highest alert that stands about them. */
function drawTraffic(context: CanvasRenderingContext2D, scene: Scene, time: number, place: Place, scale: number,
  names: boolean, theme: Theme): void {
  const alerted: { north: number; east: number; reach: number; level: number; colour: string }[] = [];
  for (const each of scene.believed(time, kBeliefShown)) {
    const alert = scene.alerting.alert(each.believer, each.track, time);
    const colour = alert ? alertColour(alert.region, theme) : theme.traffic;
    const [x, y] = place(each.north, each.east);
    context.strokeStyle = colour;
    context.lineWidth = alert ? 2 : 1;
    context.beginPath();
    context.arc(x, y, Math.max(3, 2 * each.deviation * scale), 0, 7);
    context.stroke();
    if (alert)
      alerted.push({ ...each, reach: Math.max(150, 3 * each.deviation), level: alert.level, colour });
  }
  alerted.sort((a, b) => b.level - a.level);
  context.lineWidth = 1.6;
  for (const each of scene.traffic) {
    const at = objectAt(each, time);
    if (!at || Number.isNaN(at[0])) continue;
    const alert = alerted.find((a) => Math.hypot(a.north - at[0], a.east - at[1]) < a.reach);
    const [x, y] = place(at[0], at[1]);
    context.strokeStyle = alert?.colour ?? theme.traffic;
    context.fillStyle = alert?.colour ?? theme.paper;
    context.beginPath();
    context.moveTo(x, y - 5);
    context.lineTo(x + 5, y);
    context.lineTo(x, y + 5);
    context.lineTo(x - 5, y);
    context.closePath();
    context.fill();
    context.stroke();
    if (names && scene.traffic.length <= kMany) label(context, each.name, x + 8, y + 4, theme);
  }
}

/** Paths that are recommended to pilots. */
function drawRecommendations(context: CanvasRenderingContext2D, scene: Scene, time: number, place: Place, theme: Theme): void {
  context.strokeStyle = theme.recommended;
  context.lineWidth = 2;
  context.setLineDash([8, 4]);
  for (const aircraft of scene.alerting.aircraft()) {
    const shown = scene.alerting.recommendation(aircraft, time);
    if (!shown) continue;
    context.beginPath();
    shown.path.filter((point) => point.time_s >= time - 5).forEach((point, i) => {
      const [x, y] = place(point.north_m, point.east_m);
      if (i === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    });
    context.stroke();
  }
  context.setLineDash([]);
}

function traceCorners(context: CanvasRenderingContext2D, line: Corner[], place: Place): void {
  line.forEach(([north, east], i) => {
    const [x, y] = place(north, east);
    if (i === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
}

/** Areas and lines of missions that have begun. */
function drawMissions(context: CanvasRenderingContext2D, scene: Scene, time: number, place: Place,
  names: boolean, theme: Theme): void {
  context.strokeStyle = theme.mission;
  context.lineWidth = 1.6;
  context.setLineDash([2, 3]);
  for (const mission of scene.missions) {
    if (mission.begun_s > time + 1e-3) continue;
    context.beginPath();
    for (const area of mission.areas) {
      traceCorners(context, area, place);
      context.closePath();
    }
    for (const line of mission.lines) traceCorners(context, line, place);
    context.stroke();
    const first = (mission.areas[0] ?? mission.lines[0])[0];
    const [x, y] = place(first[0], first[1]);
    if (names) label(context, mission.name, x + 5, y - 6, theme);
  }
  context.setLineDash([]);
}

/** No-fly zones in force. */
function drawZones(context: CanvasRenderingContext2D, scene: Scene, time: number, place: Place,
  names: boolean, theme: Theme): void {
  for (const zone of scene.zones) {
    if (zone.on_s > time + 1e-3 || (zone.off_s !== null && zone.off_s <= time)) continue;
    context.beginPath();
    traceCorners(context, zone.ring, place);
    context.closePath();
    context.fillStyle = theme.zoneFill;
    context.fill();
    context.strokeStyle = theme.zone;
    context.lineWidth = 1.4;
    context.stroke();
    const middle = zone.ring.reduce((sum, p) => [sum[0] + p[0] / zone.ring.length, sum[1] + p[1] / zone.ring.length], [0, 0]);
    const [x, y] = place(middle[0], middle[1]);
    if (names && zone.name) label(context, zone.name, x - 3 * zone.name.length, y + 4, theme);
  }
}

/** The bearing from the middle of `near` in which `far` reaches furthest beyond it. */
function widest(near: Ring, far: Ring): { north: number; east: number; bearing: number } {
  const middle = (all: Float32Array) => all.reduce((sum, v) => sum + v, 0) / all.length;
  const north = middle(near.north), east = middle(near.east);
  let most = -1, bearing = 0;
  for (let i = 0; i < far.north.length; ++i) {
    let least = Infinity;
    for (let k = 0; k < near.north.length; ++k)
      least = Math.min(least, Math.hypot(far.north[i] - near.north[k], far.east[i] - near.east[k]));
    if (least > most) {
      most = least;
      bearing = Math.atan2(far.east[i] - east, far.north[i] - north);
    }
  }
  return { north, east, bearing };
}

/** Where the boundary was believed to be later: the further ahead, the fainter. */
function drawAhead(context: CanvasRenderingContext2D, scene: Scene, time: number, place: Place, names: boolean, theme: Theme): void {
  const all = scene.ahead(time).filter(({ rings }) => rings.length > 0 && rings[0].north.length > 0);
  if (all.length === 0) return;
  // Labels where the rings lie furthest apart.
  const at = names ? widest(all[0].rings[0], all[all.length - 1].rings[0]) : null;
  for (const { time: when, rings } of all) {
    const minutes = Math.round((when - time) / 60);
    trace(context, rings, place);
    context.strokeStyle = theme.belief;
    context.globalAlpha = Math.max(0.3, 0.8 - minutes / 100);
    context.lineWidth = 1.2;
    context.setLineDash([2, 4]);
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
    if (!at) continue;
    const { north, east } = rings[0];
    const off = (i: number) =>
      Math.cos(Math.atan2(east[i] - at.east, north[i] - at.north) - at.bearing);
    let best = 0;
    for (let i = 1; i < north.length; ++i) if (off(i) > off(best)) best = i;
    const [x, y] = place(north[best], east[best]);
    label(context, `in ${minutes} min`, x + 3, y - 4, theme);
  }
}

/** Draws everything; the context's units are CSS pixels. */
export function drawMap(context: CanvasRenderingContext2D, scene: Scene, heights: Uint16Array | null,
  time: number, view: View, width: number, height: number, layers: Layers, theme: Theme): void {
  const place: Place = (north, east) => [
    width / 2 + (east - view.east) * view.scale,
    height / 2 - (north - view.north) * view.scale,
  ];
  context.fillStyle = theme.paper;
  context.fillRect(0, 0, width, height);
  context.lineJoin = "round";

  if (layers.terrain && scene.terrain && heights) {
    const t = scene.terrain, half = t.spacing_m / 2;
    const [x0, y1] = place(t.low_north_m - half, t.low_east_m - half);
    const [x1, y0] = place(t.low_north_m + (t.rows - 0.5) * t.spacing_m, t.low_east_m + (t.columns - 0.5) * t.spacing_m);
    context.imageSmoothingEnabled = true;
    context.drawImage(relief(t, heights, theme.dark, theme.shade), x0, y0, x1 - x0, y1 - y0);
  } else {
    drawGrid(context, view, width, height, place, theme);
  }

  const truth = scene.truth(time), belief = scene.belief(time);
  if (layers.truth) {
    trace(context, truth, place);
    context.fillStyle = theme.truthFill;
    context.fill("evenodd");
    context.strokeStyle = theme.truth;
    context.lineWidth = 1.6;
    context.stroke();
  }
  if (layers.band) {
    traceBand(context, belief, place);
    context.fillStyle = theme.bandFill;
    context.fill("nonzero");
  }
  if (layers.belief) {
    trace(context, belief, place);
    context.strokeStyle = theme.belief;
    context.lineWidth = 2;
    context.setLineDash([7, 4]);
    context.stroke();
    context.setLineDash([]);
  }
  if (layers.ahead) drawAhead(context, scene, time, place, layers.names, theme);
  if (layers.crossings) {
    const { time: when, north, east } = scene.crossings;
    const radius = scene.tracks.length > kMany ? 1.5 : 3;
    context.fillStyle = theme.crossing;
    for (let i = 0; i < when.length; ++i) {
      const age = time - when[i];
      if (age < 0 || age > kCrossingShown) continue;
      const [x, y] = place(north[i], east[i]);
      context.globalAlpha = 0.15 + 0.75 * (1 - age / kCrossingShown);
      context.beginPath();
      context.arc(x, y, radius, 0, 7);
      context.fill();
    }
    context.globalAlpha = 1;
  }
  if (layers.missions) drawMissions(context, scene, time, place, layers.names, theme);
  if (layers.zones) drawZones(context, scene, time, place, layers.names, theme);
  if (layers.objects) drawObjects(context, scene, time, place, layers.names, theme);
  if (layers.traffic) drawTraffic(context, scene, time, place, view.scale, layers.names, theme);
  if (layers.traffic) drawRecommendations(context, scene, time, place, theme);
  drawTracks(context, scene, time, place, layers, theme);
  drawScale(context, view, width, height, theme);
}
