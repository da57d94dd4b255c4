// SPDX-License-Identifier: Apache-2.0
/** The map of a run, or those of two runs side by side, which one player moves through their time. */
import { listenToKeys } from "../common/keys";
import type { MapView } from "../common/map/map_view";
import { Player } from "../common/player";
import { T } from "../common/texts";
import { replayButtons, timeSlider } from "../common/timeline";
import { timeControls } from "../common/page_controls";
import type { RunData } from "./data";
import { h } from "../common/dom";
import { printedMaps } from "./printed_maps";
import { RunFrame, unpack, type ShownRun } from "./run_frame";

const kFrames = 2; // that stand side by side

/** Two maps are looked at from the same point; returns what ends that. */
function link(maps: MapView[]): () => void {
  let moving = false;
  const ends = maps.map((from) => {
    const follow = () => {
      if (moving) return;
      moving = true;
      for (const to of maps) if (to !== from) to.lookFrom(from.outlook);
      moving = false;
    };
    from.map.on("move", follow);
    return () => {
      from.map.off("move", follow);
    };
  });
  return () => {
    for (const end of ends) end();
  };
}

export class MapPanel {
  readonly element = h("div", { class: "run-maps" });
  /** Called whenever another time is shown, or another run. */
  onTime: (time: number) => void = () => undefined;
  private readonly player: Player;
  private readonly frames: RunFrame[];
  private readonly bar = h("div", { class: "map-bar shared" });
  private unlink: () => void = () => undefined;

  /** Makes the panel of the runs that have a map; null when none has. */
  static async make(runs: RunData[]): Promise<MapPanel | null> {
    const shown = (await Promise.all(runs.map(unpack))).filter((each): each is ShownRun => each !== null);
    return shown.length > 0 ? new MapPanel(shown) : null;
  }

  private constructor(private readonly all: ShownRun[]) {
    this.player = new Player(Math.max(...all.map(({ run }) => run.duration_s)));
    this.player.time = this.player.end; // the first look is at the result; playing starts at the beginning
    const single = all.length === 1,
      dimension = () => this.turn();
    this.frames = all
      .slice(0, kFrames)
      .map(
        (shown) =>
          new RunFrame(shown, this.player, { bar: (frame) => (single ? timeControls(frame.view) : this.choice(frame)), isOneOfSeveral: !single, dimension }),
      );
    this.element.append(...(single ? [] : [this.bar]), h("div", { class: "map-frames" }, ...this.frames.map(({ element }) => element)));
    this.join();
    this.player.listeners.push(() => this.tell());
    listenToKeys(
      { " ": () => (this.player.playing ? this.player.pause() : this.player.play()), ".": () => this.first.view.step(1), ",": () => this.first.view.step(-1) },
      () => false,
      this.element,
    );
    printedMaps(this.element, this.player, () =>
      this.frames.map((frame) => ({ map: frame.view.map, text: (time) => [single ? "" : frame.run.label, frame.figures(time)].filter(Boolean).join(": ") })),
    );
  }

  /** The frame of the only run, or the left one. */
  get first(): RunFrame {
    return this.frames[0];
  }

  private choice(frame: RunFrame): HTMLElement {
    const select = h(
      "select",
      { "aria-label": "Run on the map", onchange: () => this.change(frame, this.all[Number(select.value)]) },
      ...this.all.map((each, i) => h("option", { value: i, selected: each.run === frame.run }, each.run.label)),
    );
    return select;
  }

  // Another run is looked at from where the one before was.
  private change(frame: RunFrame, shown: ShownRun): void {
    const { outlook } = frame.view.map;
    this.unlink();
    frame.change(shown);
    if (this.frames.every((each) => each.isAt(this.first))) frame.view.map.lookFrom(outlook);
    this.join();
    this.tell();
  }

  // What belongs to all frames, for the runs that are shown now.
  private join(): void {
    if (this.frames.length < 2) return;
    const { view } = this.first,
      events = () => this.frames.flatMap((each) => each.view.events).sort((a, b) => a.time_s - b.time_s);
    this.bar.replaceChildren(timeControls(view), replayButtons(view, events), timeSlider(view));
    this.unlink = this.frames.every((each) => each.isAt(this.first)) ? link(this.frames.map((each) => each.view.map)) : () => undefined;
  }

  private turn(): void {
    const on = !this.first.view.map.is3d;
    for (const { view } of this.frames) view.map.set3d(on);
  }

  /** Stands still at a time. */
  seek(time: number): void {
    this.player.stand(time);
  }

  private tell(): void {
    const { time } = this.player;
    for (const frame of this.frames) frame.showTime(time);
    this.onTime(time);
  }

  /** Shows the time where the player is, everywhere: once, when all is put together. */
  start(): void {
    this.tell();
  }
}

/** What stands in place of the map of a browser that cannot draw it. */
export const noMap = (problem: unknown): HTMLElement =>
  h("p", { class: "failure", role: "status" }, /WebGL/.test(String(problem)) ? T.map.noWebgl : String(problem));
