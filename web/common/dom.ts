// SPDX-License-Identifier: Apache-2.0
/** Small helpers to build the page: no framework, no markup from data. */

type Child = Node | string | null | undefined;
type Attributes = Record<string, string | number | boolean | EventListener | undefined>;

/** Makes an element; `on...` attributes are listeners, false and undefined are left out. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) if (child != null) element.append(child);
  return element;
}

/** A titled part of the page. */
export function section(title: string, id: string, ...children: Child[]): HTMLElement {
  return h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), ...children);
}

/** 75 s as "1:15", from an hour on "1:01:15". */
export function clock(seconds: number): string {
  const whole = Math.round(seconds);
  const two = (n: number) => String(n).padStart(2, "0");
  const s = two(whole % 60),
    m = Math.floor(whole / 60) % 60,
    hours = Math.floor(whole / 3600);
  return hours > 0 ? `${hours}:${two(m)}:${s}` : `${m}:${s}`;
}

/** A number with about `digits` significant digits and thin spaces between thousands. */
export function number(value: number | null | undefined, digits = 3): string {
  if (value == null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) return value.toExponential(digits - 1).replace("-", "−");
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = value.toFixed(Number.isInteger(value) ? 0 : Math.min(decimals, 8));
  const [whole, part] = text.replace("-", "−").split(".");
  const spaced = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u2009") : whole;
  return part ? `${spaced}.${part}` : spaced;
}

/** A number on an axis: as few digits as it needs. */
export function tick(value: number): string {
  if (value === 0) return "0";
  const text = number(value, 6);
  if (text.includes("e")) return text.replace(/\.?0+e\+?/, "e");
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}
