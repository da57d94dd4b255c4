// SPDX-License-Identifier: Apache-2.0
/** Small parts that several panels use. */
import { h } from "./dom";
import { T } from "./texts";

const kSvg = "http://www.w3.org/2000/svg";

/** Pictures of buttons: paths in a square of 24. */
const kIcons: Record<string, string> = {
  play: "M7 4.5v15l12-7.5z",
  pause: "M7 5h3.5v14H7zM13.5 5H17v14h-3.5z",
  step: "M5 5v14l9-7zM16 5h3v14h-3z",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  north: "M12 3l6 17-6-4-6 4z",
  follow: "M12 8a4 4 0 100 8 4 4 0 000-8zM12 2v4M12 18v4M2 12h4M18 12h4",
  measure: "M3 16L16 3l5 5L8 21zM7 12l2 2M10 9l2 2M13 6l2 2",
  layers: "M12 3l9 5-9 5-9-5zM3 13l9 5 9-5",
  close: "M6 6l12 12M18 6L6 18",
  settings: "M4 7h10M18 7h2M4 17h2M10 17h10M16 4.5v5M8 14.5v5",
  help: "M9 9a3 3 0 116 0c0 2-3 2.2-3 5M12 17.5v1",
  panels: "M4 5h16v14H4zM14.5 5v14",
  sun: "M12 8a4 4 0 100 8 4 4 0 000-8z",
  fleet: "M12 3l2 7 7 4v2l-7-2-1 5 2 1.5V22l-3-1-3 1v-1.500l2-1.500-1-5-7 2v-2l7-4z",
  fire: "M12 3c1 4 5 5.500 5 10.500A5 5 0 0112 19a5 5 0 01-5-5.500C7 11 8.500 10 9 8c1.500 1 2 2 2 3 1-2 1.500-5 1-8z",
  mission: "M5 21V4M5 5h12l-2.500 4L17 13H5",
  events: "M5 6h14M5 12h14M5 18h9",
  plots: "M4 4v16h16M7 15l4-5 3 3 5-7",
  links: "M6 8a2 2 0 100-4 2 2 0 000 4zM18 10a2 2 0 100-4 2 2 0 000 4zM12 20a2 2 0 100-4 2 2 0 000 4zM8 6.500l8 1M7 8l4 8M17 10l-4 6",
  instructor: "M12 4L2 9l10 5 10-5zM6 11.500V16c3 3 9 3 12 0v-4.500",
  warning: "M12 3L2 20h20zM12 9v5M12 16.500v1.200",
  person: "M12 4a4 4 0 100 8 4 4 0 000-8zM4 21c1-5 4-7 8-7s7 2 8 7",
  select: "M6 3l12 9-5.500 1L16 20l-3 1-3-7-4 4z",
  point: "M12 9a3 3 0 100 6 3 3 0 000-6z",
  linestring: "M4 18l6-9 4 6 6-10",
  polygon: "M5 8l8-4 7 8-5 8-9-3z",
  circle: "M12 4a8 8 0 100 16 8 8 0 000-16z",
  undo: "M9 6L4 11l5 5M5 11h9a5 5 0 010 10h-3",
  redo: "M15 6l5 5-5 5M19 11h-9a5 5 0 000 10h3",
  trash: "M5 7h14M9 7V4h6v3M7 7l1 13h8l1-13",
  first: "M6 5v14M18 5l-9 7 9 7z",
  previous: "M16 5l-9 7 9 7z",
  next: "M8 5l9 7-9 7z",
  check: "M5 12.500l4.500 4.500L19 7.500",
  target: "M12 5a7 7 0 100 14 7 7 0 000-14zM12 11a1 1 0 100 2 1 1 0 000-2z",
};
const kFilled = new Set(["play", "pause", "step", "north", "first", "previous", "next", "select", "fleet"]);

export function icon(name: string): SVGElement {
  const svg = document.createElementNS(kSvg, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  svg.setAttribute("class", kFilled.has(name) ? "icon filled" : "icon");
  const path = document.createElementNS(kSvg, "path");
  path.setAttribute("d", kIcons[name] ?? "");
  svg.append(path);
  return svg;
}

/** A button with a picture, and a name for who cannot see it. */
export function iconButton(name: string, label: string, action: () => void, more: Record<string, string | boolean> = {}): HTMLButtonElement {
  const button = h("button", { type: "button", class: "icon-button", title: label, "aria-label": label, onclick: () => action(), ...more });
  button.append(icon(name));
  return button;
}

export function button(text: string, action: () => void, more: Record<string, string | boolean> = {}): HTMLButtonElement {
  return h("button", { type: "button", onclick: () => action(), ...more }, text);
}

/** Sets a text only where it has changed: the browser need not lay out the rest. */
export function setText(element: Node, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

export function option(value: string, text: string, selected = false): HTMLOptionElement {
  return h("option", { value, selected }, text);
}

let labelled = 0;

/** A field with its label. */
export function labelledField(text: string, field: HTMLElement, unit = "", help = ""): HTMLElement {
  const id = field.id || `field-${++labelled}`;
  field.id = id;
  return h(
    "div",
    { class: "field" },
    h("label", { for: id }, text, unit ? h("span", { class: "unit" }, ` ${unit}`) : null),
    field,
    help ? h("span", { class: "help" }, help) : null,
  );
}

/** A list of terms and what they are now. */
export class Facts {
  readonly element = h("dl", { class: "facts" });
  private readonly values = new Map<string, HTMLElement>();
  set(name: string, text: string, kind = ""): void {
    let value = this.values.get(name);
    if (!value) {
      value = h("dd", {});
      this.values.set(name, value);
      this.element.append(h("div", {}, h("dt", {}, name), value));
    }
    setText(value, text);
    if (value.className !== kind) value.className = kind;
  }
}

/** A dialog that takes the focus and gives it back. */
export function dialog(title: string, ...content: (Node | string)[]): HTMLDialogElement {
  const id = `dialog-${++labelled}`;
  const element = h("dialog", { "aria-labelledby": id, class: "dialog" });
  element.append(
    h(
      "header",
      {},
      h("h2", { id }, title),
      iconButton("close", T.close, () => element.close()),
    ),
    ...content,
  );
  element.addEventListener("close", () => element.remove());
  element.addEventListener("click", (event) => {
    if (event.target === element) element.close();
  });
  document.body.append(element);
  element.showModal();
  return element;
}

/** A button that opens a small panel beside it; Esc and a click elsewhere close it. */
export function popover(opener: HTMLButtonElement, panel: HTMLElement): { close: () => void; toggle: () => void } {
  panel.hidden = true;
  opener.setAttribute("aria-expanded", "false");
  const set = (open: boolean) => {
    panel.hidden = !open;
    opener.setAttribute("aria-expanded", String(open));
    if (open) panel.querySelector<HTMLElement>("input, select, button")?.focus({ preventScroll: true });
  };
  opener.addEventListener("click", () => set(panel.hidden));
  document.addEventListener("pointerdown", (event) => {
    if (!panel.hidden && !panel.contains(event.target as Node) && !opener.contains(event.target as Node)) set(false);
  });
  panel.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    set(false);
    opener.focus();
  });
  return { close: () => set(false), toggle: () => set(panel.hidden) };
}
