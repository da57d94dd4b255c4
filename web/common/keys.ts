// SPDX-License-Identifier: Apache-2.0
/** Keys of the whole page; the help lists them. */
import { h } from "./dom";
import { T } from "./texts";
import { dialog } from "./ui";

export type Keys = Record<string, () => void>;

/** Writes into a field, or moves in a list of its own. */
function typing(target: EventTarget | null): boolean {
  return (
    target instanceof HTMLElement &&
    (target.isContentEditable ||
      (/^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName) && (target as HTMLInputElement).type !== "checkbox") ||
      target.closest("dialog") !== null)
  );
}

/** @param where  whose keys they are: of the page, or of a part of it that has the focus */
export function listenToKeys(keys: Keys, first: (event: KeyboardEvent) => boolean, where: Document | HTMLElement = document): void {
  where.addEventListener("keydown", (of) => {
    const event = of as KeyboardEvent;
    if (event.defaultPrevented) return;
    if (!typing(event.target) && first(event)) return event.preventDefault();
    if (typing(event.target) || event.altKey || event.metaKey) return;
    const name = `${event.ctrlKey ? "Ctrl " : ""}${event.key.length === 1 ? event.key.toLowerCase() : event.key}`;
    // A button that has the focus takes its own space bar.
    if (name === " " && event.target instanceof HTMLButtonElement) return;
    const act = keys[name];
    if (!act) return;
    event.preventDefault();
    act();
  });
}

export function showKeys(): void {
  dialog(
    T.keys.title,
    h(
      "table",
      { class: "table keys" },
      h("tbody", {}, ...T.keys.list.map(([key, what]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, key)), h("td", {}, what)))),
    ),
  );
}
