// SPDX-License-Identifier: MIT
// How far what is drawn jumps between two frames (section 3.3, figure 2).

/// x + 2 q.xyz cross (q.xyz cross x + q.w x): the place of rest offset (x, y, z) in a pose.
function place(pose, p, x, y, z, to) {
  const at = 8 * p;
  const qx = pose[at + 4], qy = pose[at + 5], qz = pose[at + 6], qw = pose[at + 7];
  const tx = qy * z - qz * y + qw * x, ty = qz * x - qx * z + qw * y, tz = qx * y - qy * x + qw * z;
  to[0] = pose[at] + x + 2 * (qy * tz - qz * ty);
  to[1] = pose[at + 1] + y + 2 * (qz * tx - qx * tz);
  to[2] = pose[at + 2] + z + 2 * (qx * ty - qy * tx);
}

/// The farthest that a vertex drawn by its rigid reference moves from one frame to the next, m: by
/// the smoothed pose (`drawn`) and by the simulation's own (`target`). A vertex of a piece that has
/// just come off was drawn before with the piece that it came off.
export function largestJump(before, after) {
  const { rest, piece, restCentre, parent } = after.shape;
  const pieces = before.columns.pose.length / 8;
  const was = Array.from({ length: parent.length }, (_, p) => {
    while (p >= pieces) p = parent[p];
    return p;
  });
  const old = [0, 0, 0], now = [0, 0, 0];
  const result = { drawn: 0, target: 0 };
  const centres = before.shape.restCentre;
  for (const [key, name] of [['drawnPose', 'drawn'], ['pose', 'target']]) {
    let most = 0;
    for (let v = 0; v < piece.length; ++v) {
      const p = piece[v], q = was[p];
      if (!(p < was.length)) continue; // no tetrahedron has it
      const x = rest[3 * v], y = rest[3 * v + 1], z = rest[3 * v + 2];
      place(before.columns[key], q, x - centres[4 * q], y - centres[4 * q + 1], z - centres[4 * q + 2], old);
      place(after.columns[key], p, x - restCentre[4 * p], y - restCentre[4 * p + 1], z - restCentre[4 * p + 2], now);
      most = Math.max(most, (now[0] - old[0]) ** 2 + (now[1] - old[1]) ** 2 + (now[2] - old[2]) ** 2);
    }
    result[name] = Math.sqrt(most);
  }
  return result;
}
