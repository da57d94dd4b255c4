// SPDX-License-Identifier: Apache-2.0
/**
 * Alerts: what wants attention now, the most urgent first, seen, heard and acknowledged. Three
 * priorities as crewed aviation has them: warnings want an act at once, cautions soon, advisories
 * only that they are known.
 */
import { h } from "../common/dom";
import { eventKind } from "../common/events";
import type { App } from "./app";
import { T } from "../common/texts";
import { button, icon, iconButton } from "../common/ui";

export type Priority = 0 | 1 | 2; // warning, caution, advisory

interface Alert {
  key: string;
  priority: Priority;
  text: string;
  since: number;
  go?: () => void;
}

const kLowBattery = 0.15;
const kLate = 5; // the clock is late for so long before it is told [s]
const kMostShown = 3;
const kAlarmShown = 60; // after an event that is an alarm, unless acknowledged [s]
const kAlarmsSought = 50; // newest events

/** Tones [Hz] and how often they are repeated, by priority. */
const kTones: { tones: number[]; times: number }[] = [
  { tones: [880, 660], times: 3 },
  { tones: [660], times: 2 },
  { tones: [520], times: 1 },
];

class Voice {
  private audio: AudioContext | null = null;

  play(priority: Priority): void {
    try {
      // Browsers let nothing sound before the user has touched the page.
      if (navigator.userActivation && !navigator.userActivation.hasBeenActive) return;
      this.audio ??= new AudioContext();
      const { tones, times } = kTones[priority],
        start = this.audio.currentTime + 0.02;
      for (let k = 0; k < times; ++k)
        tones.forEach((frequency, j) => {
          const at = start + 0.4 * k + 0.16 * j,
            o = this.audio!.createOscillator(),
            gain = this.audio!.createGain();
          o.frequency.value = frequency;
          gain.gain.setValueAtTime(0, at);
          gain.gain.linearRampToValueAtTime(0.2, at + 0.02);
          gain.gain.setValueAtTime(0.2, at + 0.12);
          gain.gain.linearRampToValueAtTime(0, at + 0.15);
          o.connect(gain).connect(this.audio!.destination);
          o.start(at);
          o.stop(at + 0.16);
        });
    } catch {
      // No sound: the alert is seen all the same.
    }
  }
}

export class Alerts {
  readonly element = h("div", { class: "alerts", "aria-label": T.alerts.title, role: "region" });
  private readonly live = h("div", { class: "visually-hidden", role: "alert" });
  private readonly list = h("ul", {});
  private current: Alert[] = [];
  private readonly acknowledged = new Set<string>();
  private readonly known = new Set<string>();
  private refusals: Alert[] = [];
  private readonly voice = new Voice();
  private shown = "";
  private lateSince = Infinity;

  constructor(private readonly app: App) {
    this.element.append(this.live, this.list);
    app.every((wall) => this.update(wall));
  }

  /** A command that was refused is told until it is acknowledged. */
  refuse(what: string, why: string): void {
    const wall = performance.now() / 1000;
    this.refusals.push({ key: `refused ${wall}`, priority: 1, text: T.alerts.refused(what, why), since: wall });
    if (this.refusals.length > 5) this.refusals.shift();
    this.update(wall);
  }

  private collect(wall: number): Alert[] {
    const { app } = this,
      { world, units } = app,
      { fleet } = world;
    const out: Alert[] = [...this.refusals];
    const add = (priority: Priority, key: string, text: string, go?: () => void) => out.push({ key, priority, text, since: wall, go });
    if (app.connection.state === "lost") add(0, "connection", T.alerts.lost);
    const { paused, speed, wanted_speed } = world.clock;
    this.lateSince = !paused && wanted_speed > 0 && speed < 0.9 * wanted_speed ? Math.min(this.lateSince, wall) : Infinity;
    if (wall - this.lateSince > kLate) add(2, "clock", T.alerts.clock);
    for (const alert of world.alerts.values()) {
      const priority: Priority = alert.region === "NEAR" ? 0 : alert.region === "MID" || alert.region === "RECOVERY" ? 1 : 2;
      const side = alert.bearing_deg == null ? "" : T.alerts.side(Math.round(Math.abs(alert.bearing_deg)), alert.bearing_deg < 0);
      add(
        priority,
        `traffic ${alert.entity_id} ${alert.track} ${alert.region}`,
        T.alerts.traffic(world.name(alert.entity_id), T.alertRegion[alert.region] ?? "", units.distance(alert.distance_m), side),
        () => this.show(alert.entity_id),
      );
    }
    for (let row = 0; row < fleet.count; ++row) {
      const id = fleet.ids[row];
      if (fleet.get(row, "failsafe") > 0) {
        const failsafe = fleet.word(row, "failsafe");
        add(
          failsafe === "motor" || failsafe === "imu" ? 0 : 1,
          `failsafe ${id} ${failsafe}`,
          T.alerts.failsafe(world.name(id), T.task.failsafes[failsafe] ?? failsafe, T.task.reactions[fleet.word(row, "reaction")] ?? ""),
          () => this.show(id),
        );
      } else if (fleet.get(row, "charge") < kLowBattery && fleet.get(row, "on_ground") !== 1) {
        add(2, `battery ${id}`, T.alerts.low(world.name(id), units.percent(fleet.get(row, "charge"))), () => this.show(id));
      }
    }
    for (const event of world.events.slice(-kAlarmsSought))
      if (eventKind(event.kind).severity === "alarm" && world.time - event.time_s < kAlarmShown)
        add(0, `event ${event.number}`, T.alerts.event(world.whose(event), event.text || event.kind), () => app.jumpTo(event));
    for (const each of world.allocations.values())
      if (each.state === "waits") add(2, `proposal ${each.proposer_id} ${each.number}`, T.alerts.proposal(each.number), () => app.showPanel("mission"));
    return out;
  }

  private show(id: number): void {
    this.app.map.select([id]);
    this.app.map.centreOn(id);
    this.app.showPanel("fleet");
  }

  private update(wall: number): void {
    const all = this.collect(wall),
      keys = new Set(all.map(({ key }) => key));
    for (const key of [...this.acknowledged]) if (!keys.has(key)) this.acknowledged.delete(key); // over: the next one is new
    for (const key of [...this.known]) if (!keys.has(key)) this.known.delete(key);
    this.current = all.filter(({ key }) => !this.acknowledged.has(key)).sort((a, b) => a.priority - b.priority);
    let loudest: Priority | null = null;
    for (const alert of this.current) {
      if (this.known.has(alert.key)) continue;
      this.known.add(alert.key);
      if (loudest === null || alert.priority < loudest) loudest = alert.priority;
    }
    if (loudest !== null && this.app.settings.sound && this.app.world.complete) this.voice.play(loudest);
    const key =
      this.current
        .slice(0, kMostShown)
        .map(({ key: each, text }) => each + text)
        .join("|") + this.current.length;
    if (key === this.shown) return;
    if (loudest !== null) this.live.textContent = this.current[0]?.text ?? "";
    this.shown = key;
    this.draw();
  }

  private draw(): void {
    const shown = this.current.slice(0, kMostShown),
      rest = this.current.length - shown.length;
    this.list.replaceChildren(
      ...shown.map((alert) => {
        const name = ["warning", "caution", "advisory"][alert.priority];
        const text = h(
          "button",
          { type: "button", class: "alert-text", disabled: !alert.go, onclick: () => alert.go?.() },
          h("strong", {}, T.alerts.priorities[alert.priority]),
          ` ${alert.text}`,
        );
        const item = h("li", { class: `alert ${name}` });
        item.append(
          icon("warning"),
          text,
          iconButton("check", T.alerts.ack, () => this.acknowledge(alert)),
        );
        return item;
      }),
      ...(rest > 0
        ? [
            h(
              "li",
              { class: "alert-more" },
              button(`${T.alerts.ackAll} (+${rest})`, () => {
                for (const alert of [...this.current]) this.acknowledge(alert);
              }),
            ),
          ]
        : []),
    );
  }

  private acknowledge(alert: Alert): void {
    this.acknowledged.add(alert.key);
    this.refusals = this.refusals.filter(({ key }) => key !== alert.key);
    this.current = this.current.filter(({ key }) => key !== alert.key);
    this.shown = "";
    this.draw();
  }

  acknowledgeFirst(): void {
    if (this.current.length > 0) this.acknowledge(this.current[0]);
  }
}
