// SPDX-License-Identifier: Apache-2.0
// The page of a plan: everything is in the page already; this moves the map and joins the
// table with the picture.
import "./style.css";

interface View {
  scale: number;
  x: number;
  y: number;
}

const kMostScale = 200;
const svg = document.querySelector<SVGSVGElement>("svg.map");
if (svg) start(svg);
joinTable();

function start(map: SVGSVGElement): void {
  const layer = map.querySelector<SVGGElement>("#layer")!;
  const grid = map.querySelector<SVGGElement>("#grid")!;
  const fixed = Array.from(layer.querySelectorAll<SVGGElement>("g.fixed")).map((group) => ({ group, at: group.getAttribute("transform") ?? "" }));
  const width = map.viewBox.baseVal.width;
  const height = map.viewBox.baseVal.height;
  const view: View = { scale: 1, x: 0, y: 0 };

  const draw = () => {
    // Something of the map always stays in sight.
    view.x = Math.min(width * 0.8, Math.max(width * 0.2 - width * view.scale, view.x));
    view.y = Math.min(height * 0.8, Math.max(height * 0.2 - height * view.scale, view.y));
    const transform = `matrix(${view.scale} 0 0 ${view.scale} ${view.x} ${view.y})`;
    layer.setAttribute("transform", transform);
    grid.setAttribute("transform", transform);
    grid.classList.toggle("moved", view.scale !== 1 || view.x !== 0 || view.y !== 0);
    for (const { group, at } of fixed) group.setAttribute("transform", `${at} scale(${1 / view.scale})`);
    drawScale(map, width, view.scale);
  };
  const zoom = (factor: number, x: number, y: number) => {
    const scale = Math.min(kMostScale, Math.max(0.5, view.scale * factor));
    const by = scale / view.scale;
    view.x = x - by * (x - view.x);
    view.y = y - by * (y - view.y);
    view.scale = scale;
    draw();
  };
  const point = (event: MouseEvent) => {
    const box = map.getBoundingClientRect();
    return { x: ((event.clientX - box.left) * width) / box.width, y: ((event.clientY - box.top) * height) / box.height };
  };

  map.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const { x, y } = point(event);
      zoom(Math.exp(-event.deltaY * 0.0015), x, y);
    },
    { passive: false },
  );
  listenToPointers(map, view, point, zoom, draw);
  document.querySelectorAll<HTMLButtonElement>("button[data-zoom]").forEach((button) =>
    button.addEventListener("click", () => {
      const factor = Number(button.dataset.zoom);
      if (factor > 0) return zoom(factor, width / 2, height / 2);
      Object.assign(view, { scale: 1, x: 0, y: 0 });
      draw();
    }),
  );
  showPlace(map, view, point);
  new ResizeObserver(draw).observe(map);
  map.classList.add("live");
}

// One pointer drags, two pinch.
function listenToPointers(
  map: SVGSVGElement,
  view: View,
  point: (event: MouseEvent) => { x: number; y: number },
  zoom: (factor: number, x: number, y: number) => void,
  draw: () => void,
): void {
  const down = new Map<number, { x: number; y: number }>();
  map.addEventListener("pointerdown", (event) => {
    down.set(event.pointerId, point(event));
    map.setPointerCapture(event.pointerId);
  });
  map.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) return;
    const now = point(event);
    const other = [...down].find(([id]) => id !== event.pointerId)?.[1];
    down.set(event.pointerId, now);
    if (other) {
      const apart = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y);
      if (apart(before) > 1) zoom(apart(now) / apart(before), other.x, other.y);
      return;
    }
    view.x += now.x - before.x;
    view.y += now.y - before.y;
    draw();
  });
  for (const name of ["pointerup", "pointercancel"] as const) map.addEventListener(name, (event) => down.delete(event.pointerId));
}

function roundBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

// The bar has the map's width, and units of one pixel of the screen, so that its words
// can be read where the map is small.
function drawScale(map: SVGSVGElement, width: number, scale: number): void {
  const bar = document.querySelector<SVGSVGElement>("svg.bar");
  const shown = map.getBoundingClientRect().width;
  if (!bar || shown <= 0) return;
  bar.setAttribute("viewBox", `0 -8 ${shown} 20`);
  const perPixel = (Number(map.dataset.metresPerPx) * width) / shown / scale;
  const metres = roundBelow(180 * perPixel);
  const length = metres / perPixel;
  const [whole, half] = bar.querySelectorAll("rect");
  const words = bar.querySelector("text");
  whole?.setAttribute("width", String(length));
  half?.setAttribute("x", String(length / 2));
  half?.setAttribute("width", String(length / 2 - 1));
  words?.setAttribute("x", String(length + 8));
  if (words) words.textContent = metres < 1000 ? `${Number(metres.toPrecision(3))} m` : `${metres / 1000} km`;
}

function showPlace(map: SVGSVGElement, view: View, point: (event: MouseEvent) => { x: number; y: number }): void {
  const place = document.querySelector<HTMLElement>("#place");
  if (!place) return;
  const perPixel = Number(map.dataset.metresPerPx);
  map.addEventListener("pointermove", (event) => {
    const { x, y } = point(event);
    const east = Number(map.dataset.westM) + ((x - view.x) / view.scale) * perPixel;
    const north = Number(map.dataset.northM) - ((y - view.y) / view.scale) * perPixel;
    place.textContent = `east ${east.toFixed(1)} m, north ${north.toFixed(1)} m`;
  });
}

// A row of the table and its element on the map light up together.
function joinTable(): void {
  document.querySelectorAll<HTMLElement>("tr[data-element]").forEach((row) => {
    const element = document.getElementById(row.dataset.element ?? "");
    if (!element) return;
    const set = (on: boolean) => () => {
      row.classList.toggle("lit", on);
      element.classList.toggle("lit", on);
    };
    for (const part of [row, element]) {
      part.addEventListener("pointerenter", set(true));
      part.addEventListener("pointerleave", set(false));
    }
  });
}
