// SPDX-License-Identifier: Apache-2.0
/** The maps at a few times, for paper: pictures that are made when the page is printed. */
import type { MapView } from "../common/map/map_view";
import type { Player } from "../common/player";
import { clock, h } from "../common/dom";

const kParts = [0, 1 / 3, 2 / 3, 1]; // of the run

/** A map, and what is said of it at a time. */
export interface PrintedMap {
  map: MapView;
  text: (time: number) => string;
}

/** Puts them behind the map before the page is printed, and takes them away again. */
export function printedMaps(holder: HTMLElement, player: Player, maps: () => PrintedMap[]): void {
  let pictures: HTMLElement | null = null;
  window.addEventListener("beforeprint", () => {
    const { time } = player;
    player.pause();
    const figures = kParts.flatMap((part) => {
      player.seek(part * player.end);
      return maps().map(({ map, text }) => h("figure", {}, map.picture(), h("figcaption", {}, `${clock(player.time)}. ${text(player.time)}`)));
    });
    player.seek(time);
    pictures = h(
      "div",
      { class: "print-maps" },
      h(
        "p",
        {},
        "Red: true fire. Dashed blue: believed boundary, shaded: its 95 % band. Crosses: crossings of the last five minutes. " +
          "Squares: objects, filled once found. Diamonds: other aircraft; circles: where they are believed, amber and red with an alert. " +
          "Lines behind aircraft: their recent flight.",
      ),
      ...figures,
    );
    holder.append(pictures);
  });
  window.addEventListener("afterprint", () => {
    pictures?.remove();
    pictures = null;
  });
}
