// SPDX-License-Identifier: MIT
// Computing time of the last steps by stages, with a line at 16.7 ms.

export const stages = [
  ['mechanics', '#3b6ea8'],
  ['fracture', '#d9480f'],
  ['rebuild', '#e9a23b'],
  ['display', '#7a8288'],
];
const frameMs = 1000 / 60;

/// Draws the stages of `frames` up to row `shown` as bars, the newest at the right.
export function drawGraph(canvas, frames, shown) {
  const ratio = window.devicePixelRatio || 1;
  const width = (canvas.width = Math.round(canvas.clientWidth * ratio));
  const height = (canvas.height = Math.round(canvas.clientHeight * ratio));
  const pen = canvas.getContext('2d');
  const bar = 2 * ratio;
  const count = Math.min(shown + 1, Math.floor(width / bar));
  const rows = frames.slice(shown + 1 - count, shown + 1).map((f) => f.report.stageMs);
  const largest = Math.max(1.5 * frameMs, ...rows.map((ms) => ms.reduce((a, b) => a + b, 0)));
  const scale = height / largest;
  rows.forEach((ms, k) => {
    let y = height;
    ms.forEach((value, stage) => {
      pen.fillStyle = stages[stage][1];
      pen.fillRect(width - (count - k) * bar, y - value * scale, bar, value * scale);
      y -= value * scale;
    });
  });
  pen.strokeStyle = '#22272b';
  pen.setLineDash([4 * ratio, 3 * ratio]);
  pen.beginPath();
  pen.moveTo(0, height - frameMs * scale);
  pen.lineTo(width, height - frameMs * scale);
  pen.stroke();
  pen.font = `${10 * ratio}px system-ui, sans-serif`;
  pen.fillStyle = '#22272b';
  pen.strokeStyle = '#ffffff';
  pen.setLineDash([]);
  pen.lineWidth = 3 * ratio;
  for (const write of ['strokeText', 'fillText']) pen[write]('16.7 ms', 2 * ratio, height - frameMs * scale - 3 * ratio);
  let x = 56 * ratio;
  for (const [name, colour] of stages) {
    pen.fillStyle = colour;
    pen.fillText(name, x, 10 * ratio);
    x += pen.measureText(name).width + 8 * ratio;
  }
}
