/** The bar at the top: run, time, how it goes, who has control, how the page looks. */
import { clock, h } from "../report/dom";
import { chooseTheme, type ThemeChoice } from "../report/theme";
import type { App } from "./app";
import { T } from "./texts";
import { button, icon, iconButton, labelledField, option, popover, setText } from "./ui";
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
  const speed = h("select", { "aria-label": T.top.speed, title: T.top.speeds, onchange: () => view.speed(Number(speed.value)) },
    ...view.speeds.map((s) => option(String(s), speedText(s))));
  const time = h("span", { class: "run-time" }), utcText = h("span", { class: "run-utc" });
  const rate = h("span", { class: "rate" });
  const element = h("div", { class: "time-controls", role: "group", "aria-label": T.top.time },
    play, step, speed, h("div", { class: "clock", role: "timer", "aria-label": T.top.time }, time, utcText), rate);
  let shownPaused: boolean | null = null;
  view.every(() => {
    const { clock: c } = view.world, now = view.world.time;
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

function controlMenu(app: App): HTMLElement {
  const opener = h("button", { type: "button", class: "chip control" });
  const panel = h("div", { class: "popover control-panel", role: "group", "aria-label": T.top.clients });
  popover(opener, panel);
  let shown = -1;
  app.every(() => {
    const { clients, version } = app.world;
    if (shown === version.clients) return;
    shown = version.clients;
    const holder = clients.clients.find(({ client }) => client === clients.holder);
    const text = app.holds ? T.top.holder.you : holder ? T.top.holder.other(holder.name) : T.top.holder.nobody;
    opener.replaceChildren(icon("person"), h("span", {}, text), h("span", { class: "role" }, T.top.role[app.role] ?? app.role));
    opener.classList.toggle("mine", app.holds);
    opener.title = T.top.clients;
    panel.replaceChildren(h("h2", { class: "small" }, T.top.clients),
      h("ul", { class: "clients" }, ...clients.clients.map((each) => h("li", {},
        h("span", {}, each.name, each.client === clients.you ? h("em", {}, ` (${T.top.you})`) : null),
        h("span", { class: "role" }, T.top.role[each.role] ?? each.role),
        app.holds && each.client !== clients.you && each.role !== "viewer"
          ? button(T.top.handOver(each.name), () => app.connection.send({ hand_over: each.client }, T.commands.handOver(each.name))) : null))),
      app.mayCommand ? button(app.holds ? T.top.give : T.top.take, () => app.hold(!app.holds), { class: "primary" }) : h("p", {}, T.top.role.viewer));
  });
  return h("div", { class: "popover-holder" }, opener, panel);
}

/** How the page looks, and what else is chosen for it. */
export function settingsMenu(view: RunView, more: HTMLElement[] = []): HTMLElement {
  const { settings } = view;
  const opener = iconButton("settings", T.top.settings, () => undefined);
  const theme = h("select", { onchange: () => {
    settings.theme = theme.value as ThemeChoice;
    view.saveSettings();
    applyTheme(settings.theme);
  } }, ...Object.entries(T.top.themes).map(([value, text]) => option(value, text, value === settings.theme)));
  const units = h("select", { onchange: () => {
    settings.units = units.value as typeof settings.units;
    view.saveSettings();
    view.map.redraw();
  } }, ...Object.entries(T.top.unitSets).map(([value, text]) => option(value, text, value === settings.units)));
  const panel = h("div", { class: "popover settings-panel", role: "group", "aria-label": T.top.settings },
    labelledField(T.top.theme, theme), labelledField(T.top.units, units), ...more);
  popover(opener, panel);
  return h("div", { class: "popover-holder" }, opener, panel);
}

function soundChoice(app: App): HTMLElement {
  const { settings } = app;
  const sound = h("input", { type: "checkbox", checked: settings.sound, id: "sound", onchange: () => {
    settings.sound = sound.checked;
    app.saveSettings();
  } });
  return h("label", { class: "check" }, sound, T.top.sound);
}

/** Turns the map into three dimensions and back. */
export function dimensionButton(view: RunView, action: () => void): HTMLElement {
  const button = h("button", { type: "button", class: "dimension", title: T.top.dimension, "aria-label": T.top.dimension, "aria-pressed": "false", onclick: action }, "3D");
  view.every(() => button.setAttribute("aria-pressed", String(view.map.is3d)));
  return button;
}

export function topBar(app: App, actions: { dimension: () => void; help: () => void; panels: () => void }): HTMLElement {
  const link = h("span", { class: "chip link", role: "status" });
  app.every((wall) => {
    const { state, nextTry } = app.connection;
    link.dataset.state = state;
    const text = state === "lost" && nextTry > wall ? `${T.top.connection.lost}, ${T.top.again(Math.max(1, Math.round(nextTry - wall)))}` : T.top.connection[state];
    setText(link, text);
  });
  return h("header", { class: "top" },
    h("div", { class: "brand" }, h("strong", {}, T.name), h("h1", {}, app.run.name), app.run.replay ? h("span", { class: "chip" }, T.top.replay) : null),
    timeControls(app),
    h("div", { class: "right" }, link, controlMenu(app), dimensionButton(app, actions.dimension), settingsMenu(app, [soundChoice(app)]),
      iconButton("help", T.top.help, actions.help), iconButton("panels", T.top.panels, actions.panels)));
}
