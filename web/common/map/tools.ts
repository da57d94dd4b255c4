// SPDX-License-Identifier: Apache-2.0
/** What clicks on the map mean at the moment: choosing an aircraft, a place, the points of a line, measuring. */
import { h } from "../dom";
import { theme } from "../theme";
import { T } from "../texts";
import type { Units } from "../units";
import { button, setText } from "../ui";
import { writeLabel } from "./field_view";
import type { Here, MapView } from "./map_view";

export class MapTools {
  /** The line that says what to do. */
  readonly hint = h("div", { class: "map-hint", role: "status", hidden: true });
  measuring = false;
  onChange: () => void = () => undefined;
  /** What a form has chosen: shown until the form is closed. */
  preview: { points: [number, number][]; area: boolean } | null = null;
  chosenDrawing: () => [number, number][] | null = () => null;
  private readonly text = h("span", {});
  private points: [number, number][] = [];
  private area = false;
  private finish: (() => void) | null = null;
  private readonly taker = (here: Here) => this.click(here);
  private onClick: ((here: Here) => void) | null = null;

  constructor(
    private readonly units: Units,
    private readonly view: MapView,
  ) {
    this.hint.append(
      this.text,
      button(T.cancel, () => this.stop()),
    );
    view.extras.push((c) => this.draw(c));
  }

  get busy(): boolean {
    return this.onClick !== null;
  }

  /** Ends whatever was begun. */
  stop(): void {
    const was = this.busy;
    this.onClick = this.finish = null;
    this.points = [];
    this.measuring = false;
    this.hint.hidden = true;
    this.view.clickTakers = this.view.clickTakers.filter((taker) => taker !== this.taker);
    this.view.map.doubleClickZoom.enable();
    if (was) this.view.redraw();
    this.onChange();
  }

  private begin(text: string, onClick: (here: Here) => void): void {
    this.stop();
    this.onClick = onClick;
    this.view.clickTakers.push(this.taker);
    this.view.map.doubleClickZoom.disable();
    setText(this.text, text);
    this.hint.hidden = false;
    this.onChange();
  }

  private click(here: Here): boolean {
    this.onClick?.(here);
    this.view.redraw();
    return true;
  }

  pickPlace(text: string, take: (here: Here) => void): void {
    this.begin(text, (here) => {
      this.stop();
      take(here);
    });
  }

  /** Points one after the other; Enter ends. */
  drawPlaces(area: boolean, text: string, take: (points: [number, number][]) => void): void {
    this.begin(text, (here) => {
      this.points.push([here.north_m, here.east_m]);
      take([...this.points]);
    });
    this.area = area;
    this.finish = () => {
      const { points } = this;
      this.stop();
      take(points);
    };
  }

  measure(): void {
    if (this.measuring) return this.stop();
    this.begin(T.map.measureHint, (here) => {
      this.points.push([here.north_m, here.east_m]);
      this.tellMeasured();
    });
    this.area = false;
    this.measuring = true;
    this.onChange();
  }

  private tellMeasured(): void {
    const { units, points: p } = this;
    if (p.length < 2) return;
    let all = 0,
      leg = 0,
      bearing = 0;
    for (let i = 1; i < p.length; ++i) {
      const north = p[i][0] - p[i - 1][0],
        east = p[i][1] - p[i - 1][1];
      leg = Math.hypot(north, east);
      bearing = (Math.atan2(east, north) * 180) / Math.PI;
      all += leg;
    }
    setText(this.text, T.map.measured(units.distance(leg), units.distance(all), units.angle(bearing)));
  }

  /** Whether a key was for the tool. */
  key(event: KeyboardEvent): boolean {
    if (!this.busy) return false;
    if (event.key === "Escape") this.stop();
    else if (event.key === "Enter" && this.finish) this.finish();
    else if (event.key === "Backspace" && this.points.length > 0) {
      this.points.pop();
      this.view.redraw();
    } else return false;
    return true;
  }

  show(points: [number, number][] | null, area = false): void {
    this.preview = points ? { points, area } : null;
    this.view.redraw();
  }

  private draw(c: CanvasRenderingContext2D): void {
    if (this.points.length > 0) this.drawPoints(c, this.points, this.area, theme().ink);
    else if (this.preview) this.drawPoints(c, this.preview.points, this.preview.area, theme().mission);
  }

  private drawPoints(c: CanvasRenderingContext2D, points: [number, number][], area: boolean, colour: string): void {
    const { camera, shaper } = this.view,
      { ink, paper } = theme(),
      line = shaper.points(points);
    c.strokeStyle = colour;
    c.lineWidth = 2.5;
    c.beginPath();
    const screen: [number, number][] = [];
    for (let i = 0; i < line.length; i += 3) if (camera.project(line[i], line[i + 1], line[i + 2])) screen.push([camera.x, camera.y]);
    screen.forEach(([x, y], k) => (k === 0 ? c.moveTo(x, y) : c.lineTo(x, y)));
    if (area && screen.length > 2) c.closePath();
    c.stroke();
    c.fillStyle = paper;
    for (const [x, y] of screen) {
      c.beginPath();
      c.arc(x, y, 4.5, 0, 7);
      c.fill();
      c.stroke();
    }
    if (!this.measuring) return;
    for (let i = 1; i < screen.length; ++i) {
      const length = Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
      writeLabel(c, this.units.distance(length), (screen[i][0] + screen[i - 1][0]) / 2 + 6, (screen[i][1] + screen[i - 1][1]) / 2 - 6, ink, paper);
    }
  }
}
