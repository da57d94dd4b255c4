// SPDX-License-Identifier: Apache-2.0
/** Colours for canvases: the style sheet's, in light, dark and on paper. */

export interface Theme {
  ink: string;
  muted: string;
  grid: string;
  paper: string;
  truth: string;
  truthFill: string;
  belief: string;
  bandFill: string;
  crossing: string;
  found: string;
  traffic: string;
  mission: string;
  zone: string;
  zoneFill: string;
  preventive: string; // alerts
  corrective: string;
  warning: string;
  recommended: string;
  dark: boolean;
  series: string[];
}

const light: Theme = {
  ink: "#1c2024",
  muted: "#60686f",
  grid: "#e3e6e8",
  paper: "#fbfbfa",
  truth: "#b3261e",
  truthFill: "rgba(217,83,30,0.20)",
  belief: "#0b5fae",
  bandFill: "rgba(11,95,174,0.22)",
  crossing: "#1c2024",
  found: "#7b2fbf",
  traffic: "#8a4b00",
  mission: "#0a6b4f",
  zone: "#8c1d40",
  zoneFill: "rgba(140,29,64,0.12)",
  preventive: "#8a6d00",
  corrective: "#d98200",
  warning: "#d0021b",
  recommended: "#b000a8",
  dark: false,
  series: ["#0b6bb5", "#d2540a", "#0a8f6b", "#a64d94", "#8a6d00", "#5b5bd6", "#7a4b2a", "#4d5963"],
};

const dark: Theme = {
  ink: "#e8eaec",
  muted: "#a0a8b0",
  grid: "#343a40",
  paper: "#181b1e",
  truth: "#ff8a70",
  truthFill: "rgba(255,112,67,0.24)",
  belief: "#6cb6ff",
  bandFill: "rgba(108,182,255,0.26)",
  crossing: "#f2f3f4",
  found: "#cf9bff",
  traffic: "#ffb454",
  mission: "#5fd6ab",
  zone: "#ff8fb0",
  zoneFill: "rgba(255,143,176,0.14)",
  preventive: "#f0e070",
  corrective: "#ffab1a",
  warning: "#ff4136",
  recommended: "#ff7bf5",
  dark: true,
  series: ["#5fb0f5", "#ff9a5c", "#3fcf9f", "#e39ad2", "#e0c341", "#a3a3ff", "#d0a07c", "#b4bec7"],
};

export type ThemeChoice = "auto" | "light" | "dark";

const wantsDark = window.matchMedia("(prefers-color-scheme: dark)");
let printing = false;
let choice: ThemeChoice = "auto"; // "auto": as the system has it
const listeners: (() => void)[] = [];

/** The colours of this moment; paper is always light. */
export function theme(): Theme {
  const darkNow = choice === "auto" ? wantsDark.matches : choice === "dark";
  return darkNow && !printing ? dark : light;
}

/** Chooses the colours, whatever the system has. */
export function chooseTheme(next: ThemeChoice): void {
  if (choice === next) return;
  choice = next;
  tell();
}

/** The colour of an alert by the region that its level stands for. */
export function alertColour(region: string | null, theme: Theme): string {
  return region === "NEAR" ? theme.warning : region === "MID" ? theme.corrective : theme.preventive;
}

/** Calls back whenever theme() changes, until the function that it returns is called. */
export function onThemeChange(listener: () => void): () => void {
  listeners.push(listener);
  return () => {
    listeners.splice(listeners.indexOf(listener), 1);
  };
}

function tell(): void {
  for (const listener of listeners) listener();
}

wantsDark.addEventListener("change", tell);
window.addEventListener("beforeprint", () => {
  printing = true;
  tell();
});
window.addEventListener("afterprint", () => {
  printing = false;
  tell();
});
