// SPDX-License-Identifier: Apache-2.0
/** The bar at the top of the operator's page: run, time, how it goes, who has control. */
import { h } from "../common/dom";
import type { App } from "./app";
import { dimensionButton, settingsMenu, timeControls } from "../common/page_controls";
import { T } from "../common/texts";
import { button, icon, iconButton, popover, setText } from "../common/ui";

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
    panel.replaceChildren(
      h("h2", { class: "small" }, T.top.clients),
      h(
        "ul",
        { class: "clients" },
        ...clients.clients.map((each) =>
          h(
            "li",
            {},
            h("span", {}, each.name, each.client === clients.you ? h("em", {}, ` (${T.top.you})`) : null),
            h("span", { class: "role" }, T.top.role[each.role] ?? each.role),
            app.holds && each.client !== clients.you && each.role !== "viewer"
              ? button(T.top.handOver(each.name), () => app.connection.send({ hand_over: each.client }, T.commands.handOver(each.name)))
              : null,
          ),
        ),
      ),
      app.mayCommand ? button(app.holds ? T.top.give : T.top.take, () => app.hold(!app.holds), { class: "primary" }) : h("p", {}, T.top.role.viewer),
    );
  });
  return h("div", { class: "popover-holder" }, opener, panel);
}

function soundChoice(app: App): HTMLElement {
  const { settings } = app;
  const sound = h("input", {
    type: "checkbox",
    checked: settings.sound,
    id: "sound",
    onchange: () => {
      settings.sound = sound.checked;
      app.saveSettings();
    },
  });
  return h("label", { class: "check" }, sound, T.top.sound);
}

export function topBar(app: App, actions: { dimension: () => void; help: () => void; panels: () => void }): HTMLElement {
  const link = h("span", { class: "chip link", role: "status" });
  app.every((wall) => {
    const { state, nextTry } = app.connection;
    link.dataset.state = state;
    const text =
      state === "lost" && nextTry > wall ? `${T.top.connection.lost}, ${T.top.again(Math.max(1, Math.round(nextTry - wall)))}` : T.top.connection[state];
    setText(link, text);
  });
  return h(
    "header",
    { class: "top" },
    h("div", { class: "brand" }, h("strong", {}, T.name), h("h1", {}, app.run.name), app.run.replay ? h("span", { class: "chip" }, T.top.replay) : null),
    timeControls(app),
    h(
      "div",
      { class: "right" },
      link,
      controlMenu(app),
      dimensionButton(app, actions.dimension),
      settingsMenu(app, [soundChoice(app)]),
      iconButton("help", T.top.help, actions.help),
      iconButton("panels", T.top.panels, actions.panels),
    ),
  );
}
