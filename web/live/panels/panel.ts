// SPDX-License-Identifier: Apache-2.0
/** What a panel of the dock is: an element, and what it does a few times a second while it is seen. */
export interface Panel {
  element: HTMLElement;
  update(wall: number): void;
}
