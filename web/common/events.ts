// SPDX-License-Identifier: Apache-2.0
/** How much events matter and how they look, by what is said of their kinds. */
import { eventKinds, type EventKind } from "./records";

/** A kind of Skein's by its name. What is no such name is a plugin's own. */
export function eventKind(name: string): EventKind {
  return Object.hasOwn(eventKinds, name) ? (eventKinds as Record<string, EventKind>)[name] : eventKinds.plugin;
}

/** Whether something fails or is refused, lost or in danger. */
export function isBad(name: string): boolean {
  const { severity } = eventKind(name);
  return severity === "warning" || severity === "alarm";
}

const kOrganised: readonly string[] = ["mission", "zone", "team", "traffic"] satisfies EventKind["subject"][];

/**
 * How an event stands on a timeline: row and shape besides colour.
 * @param sender  whose command it is; empty: none
 */
export function eventLook({ kind, sender }: { kind: string; sender: string }): { row: number; shape: "dot" | "triangle" | "square" } {
  if (isBad(kind)) return { row: 0, shape: "triangle" };
  if (sender !== "" || kOrganised.includes(eventKind(kind).subject)) return { row: 1, shape: "square" };
  return { row: 2, shape: "dot" };
}
