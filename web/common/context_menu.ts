// SPDX-License-Identifier: Apache-2.0
/** What can be done at a place of the map: by the right button, or a long press. */
import { clock, h } from "./dom";
import { latLonText, mgrsText } from "./frames";
import { askArrival } from "./geo/arrival";
import type { Here } from "./map/map_view";
import { T } from "./texts";
import { button } from "./ui";
import type { RunView } from "./view";

/** What may be done there besides asking: what it says, and what it does. */
export type PlaceActions = (place: { north_m: number; east_m: number }) => [text: string, action: () => void][];

export function contextMenu(view: RunView, stage: HTMLElement, actions: PlaceActions = () => []): void {
  let menu: HTMLElement | null = null;
  const close = () => {
    menu?.remove();
    menu = null;
  };
  const answer = (here: Here): string => {
    const asked = askArrival(view.world, here.north_m, here.east_m);
    if (!asked) return T.fire.noBelief;
    if (asked.burns) return T.fire.askedNow;
    if (asked.middle === null && asked.early === null) return T.fire.askedNever;
    const at = (time: number | null) => (time === null ? T.none : clock(time));
    return T.fire.askedAnswer(at(asked.early), at(asked.middle), at(asked.late));
  };
  const open = (here: Here) => {
    close();
    const item = (text: string, action: () => void) =>
      button(
        text,
        () => {
          close();
          action();
        },
        { role: "menuitem" },
      );
    const said = h("p", { class: "hint", role: "status" });
    menu = h(
      "div",
      {
        class: "context-menu",
        role: "menu",
        "aria-label": T.map.menu,
        tabindex: -1,
        onkeydown: (event) => {
          const { key } = event as KeyboardEvent;
          if (key === "Escape") {
            event.stopPropagation();
            return close();
          }
          const items = [...menu!.querySelectorAll<HTMLElement>("[role=menuitem]")],
            now = items.indexOf(document.activeElement as HTMLElement);
          if (key === "ArrowDown" || key === "ArrowUp") {
            event.preventDefault();
            event.stopPropagation();
            items[(now + (key === "ArrowDown" ? 1 : -1) + items.length) % items.length]?.focus();
          }
        },
      },
      ...actions({ north_m: here.north_m, east_m: here.east_m }).map(([text, action]) => item(text, action)),
      button(
        T.map.arrivalHere,
        () => {
          said.textContent = answer(here);
        },
        { role: "menuitem" },
      ),
    );
    const holder = h("div", { class: "context-holder" }, menu, said, h("p", { class: "hint" }, latLonText(here), h("br"), mgrsText(here)));
    stage.append(holder);
    menu = holder;
    const { clientWidth: width, clientHeight: height } = stage;
    holder.style.left = `${Math.max(4, Math.min(here.x, width - holder.offsetWidth - 6))}px`;
    holder.style.top = `${Math.max(4, Math.min(here.y, height - holder.offsetHeight - 40))}px`;
    holder.querySelector<HTMLElement>("[role=menuitem]")?.focus({ preventScroll: true });
  };
  view.map.onContext = open;
  document.addEventListener("pointerdown", (event) => {
    if (menu && !menu.contains(event.target as Node)) close();
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") close();
  });

  // A finger has no right button.
  let timer = 0;
  const canvas = view.map.map.getCanvas();
  canvas.addEventListener(
    "touchstart",
    (event) => {
      clearTimeout(timer);
      if (event.touches.length !== 1) return;
      const { clientX, clientY } = event.touches[0],
        box = canvas.getBoundingClientRect(),
        x = clientX - box.left,
        y = clientY - box.top;
      timer = window.setTimeout(() => {
        const at = view.map.map.unproject([x, y]);
        open({ ...view.map.place(at.lng, at.lat), x, y });
      }, 650);
    },
    { passive: true },
  );
  for (const name of ["touchmove", "touchend", "touchcancel"]) canvas.addEventListener(name, () => clearTimeout(timer), { passive: true });
}
