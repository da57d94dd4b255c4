// SPDX-License-Identifier: Apache-2.0
/**
 * Icons of aircraft in one texture. Red: the filled shape, green: its outline, blue: the frame that
 * says what is real. Columns: kinds; rows: simulated, outside simulator, real.
 */

export const kCell = 96;
export const kIconKinds = ["fixed wing", "multirotor", "station", "other"] as const;
export const kRealities = ["simulated", "outside simulator", "real"] as const;

type Draw = (c: CanvasRenderingContext2D) => void;

const wing: Draw = (c) => {
  c.beginPath();
  c.moveTo(0, -30);
  c.quadraticCurveTo(5, -24, 5, -12);
  c.lineTo(30, 2);
  c.lineTo(30, 9);
  c.lineTo(5, 5);
  c.lineTo(4, 17);
  c.lineTo(12, 23);
  c.lineTo(12, 28);
  c.lineTo(0, 25);
  c.lineTo(-12, 28);
  c.lineTo(-12, 23);
  c.lineTo(-4, 17);
  c.lineTo(-5, 5);
  c.lineTo(-30, 9);
  c.lineTo(-30, 2);
  c.lineTo(-5, -12);
  c.quadraticCurveTo(-5, -24, 0, -30);
  c.closePath();
};

const rotor: Draw = (c) => {
  c.beginPath();
  for (const [x, y] of [
    [-17, -17],
    [17, -17],
    [17, 17],
    [-17, 17],
  ]) {
    c.moveTo(x + 10, y);
    c.arc(x, y, 10, 0, 7);
  }
  c.moveTo(0, -22); // the nose
  c.lineTo(9, -4);
  c.lineTo(9, 10);
  c.lineTo(-9, 10);
  c.lineTo(-9, -4);
  c.closePath();
};

const station: Draw = (c) => {
  c.beginPath();
  c.rect(-17, -17, 34, 34);
};

const arrow: Draw = (c) => {
  c.beginPath();
  c.moveTo(0, -26);
  c.lineTo(18, 22);
  c.lineTo(0, 12);
  c.lineTo(-18, 22);
  c.closePath();
};

/** The texture's picture. */
export function iconAtlas(): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = kCell * kIconKinds.length;
  canvas.height = kCell * kRealities.length;
  const c = canvas.getContext("2d")!;
  c.globalCompositeOperation = "lighter";
  kRealities.forEach((reality, row) =>
    [wing, rotor, station, arrow].forEach((shape, column) => {
      c.save();
      c.translate((column + 0.5) * kCell, (row + 0.5) * kCell);
      c.lineJoin = "round";
      shape(c);
      c.strokeStyle = "#00ff00";
      c.lineWidth = 9;
      c.stroke();
      c.fillStyle = "#ff0000";
      c.fill();
      c.strokeStyle = "#0000ff";
      c.lineWidth = 4;
      if (reality === "real") {
        c.beginPath();
        c.arc(0, 0, 42, 0, 7);
        c.stroke();
      } else if (reality === "outside simulator") {
        c.setLineDash([11, 8]);
        c.beginPath();
        c.arc(0, 0, 42, 0, 7);
        c.stroke();
      }
      c.restore();
    }),
  );
  return canvas;
}
