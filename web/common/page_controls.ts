// SPDX-License-Identifier: Apache-2.0
/** What stands in the bar at the top of each page with a map: time, how the page looks. */
import { clock, h } from "./dom";
import { chooseTheme, type ThemeChoice } from "./theme";
import { T } from "./texts";
import { icon, iconButton, labelledField, option, popover, setText } from "./ui";
import type { RunView } from "./view";

function utc(start: string, seconds: number): string {
  const date = new Date(Date.parse(start) + 1000 * seconds);
  return Number.isNaN(date.getTime()) ? "" : `${date.toISOString().slice(11, 19)} UTC`;
}

let chosen: ThemeChoice = "auto";
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => applyTheme(chosen));

/** Shows the theme that was chosen. */
export function applyTheme(choice: ThemeChoice): void {
  chosen = choice;
  chooseTheme(choice);
  const dark = choice === "auto" ? matchMedia("(prefers-color-scheme: dark)").matches : choice === "dark";
  document.documentElement.dataset.theme = dark ? "dark" : "light";
}

const speedText = (factor: number) => (factor === 0 ? T.top.fast : `${factor}×`);

/** Play, pause, speed, and what time it is in the run. */
export function timeControls(view: RunView): HTMLElement {
  const play = iconButton("pause", T.top.pause, () => view.pause(!view.world.clock.paused));
  const step = iconButton("step", T.top.step, () => view.step(1));
  const speed = h(
    "select",
    { "aria-label": T.top.speed, title: T.top.speeds, onchange: () => view.speed(Number(speed.value)) },
    ...view.speeds.map((s) => option(String(s), speedText(s))),
  );
  const time = h("span", { class: "run-time" }),
    utcText = h("span", { class: "run-utc" });
  const rate = h("span", { class: "rate" });
  const element = h(
    "div",
    { class: "time-controls", role: "group", "aria-label": T.top.time },
    play,
    step,
    speed,
    h("div", { class: "clock", role: "timer", "aria-label": T.top.time }, time, utcText),
    rate,
  );
  let shownPaused: boolean | null = null;
  view.every(() => {
    const { clock: c } = view.world,
      now = view.world.time;
    setText(time, clock(Math.floor(now)));
    setText(utcText, utc(view.run.start_utc, now));
    if (shownPaused !== c.paused) {
      shownPaused = c.paused;
      play.replaceChildren(icon(c.paused ? "play" : "pause"));
      play.title = c.paused ? T.top.play : T.top.pause;
      play.setAttribute("aria-label", play.title);
    }
    if (document.activeElement !== speed) {
      const wanted = String(c.wanted_speed);
      if (![...speed.options].some(({ value }) => value === wanted)) speed.prepend(option(wanted, speedText(c.wanted_speed)));
      speed.value = wanted;
    }
    const late = !c.paused && !c.over && c.wanted_speed > 0 && c.speed < 0.9 * c.wanted_speed;
    rate.className = c.paused ? "rate" : late || c.misses > 0 ? "rate warn" : "rate good";
    setText(rate, c.over ? T.top.over : c.paused ? T.top.paused : T.top.realTime(c.speed >= 10 ? c.speed.toFixed(0) : c.speed.toFixed(c.speed < 2 ? 2 : 1)));
    rate.title = `${late ? T.top.clockLate : T.top.clockGood}. ${T.top.misses(c.misses)}.`;
    for (const control of [play, step, speed]) control.disabled = !view.mayMoveTime;
    step.disabled ||= !c.paused;
  });
  return element;
}

/** How the page looks, and what else is chosen for it. */
export function settingsMenu(view: RunView, more: HTMLElement[] = []): HTMLElement {
  const { settings } = view;
  const opener = iconButton("settings", T.top.settings, () => undefined);
  const theme = h(
    "select",
    {
      onchange: () => {
        settings.theme = theme.value as ThemeChoice;
        view.saveSettings();
        applyTheme(settings.theme);
      },
    },
    ...Object.entries(T.top.themes).map(([value, text]) => option(value, text, value === settings.theme)),
  );
  const units = h(
    "select",
    {
      onchange: () => {
        settings.units = units.value as typeof settings.units;
        view.saveSettings();
        view.map.redraw();
      },
    },
    ...Object.entries(T.top.unitSets).map(([value, text]) => option(value, text, value === settings.units)),
  );
  const panel = h(
    "div",
    { class: "popover settings-panel", role: "group", "aria-label": T.top.settings },
    labelledField(T.top.theme, theme),
    labelledField(T.top.units, units),
    ...more,
  );
  popover(opener, panel);
  return h("div", { class: "popover-holder" }, opener, panel);
}

/** Turns the map into three dimensions and back. */
export function dimensionButton(view: RunView, action: () => void): HTMLElement {
  const button = h(
    "button",
    { type: "button", class: "dimension", title: T.top.dimension, "aria-label": T.top.dimension, "aria-pressed": "false", onclick: action },
    "3D",
  );
  view.every(() => button.setAttribute("aria-pressed", String(view.map.is3d)));
  return button;
}
