// SPDX-License-Identifier: Apache-2.0
/** Canvases that are drawn in CSS pixels. */

/** Sizes a canvas for sharp lines and draws in CSS pixels. */
export function paint(canvas: HTMLCanvasElement, width: number, height: number, draw: (context: CanvasRenderingContext2D) => void): void {
  const ratio = Math.max(window.devicePixelRatio || 1, 1);
  const [w, k] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== k) {
    canvas.width = w;
    canvas.height = k;
  }
  const context = canvas.getContext("2d")!;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  draw(context);
}
