// SPDX-License-Identifier: MIT
// What Khronos' validator and three.js say of GLB files: node check_glb.mjs FILE.glb...
import validator from 'gltf-validator';
import { readFileSync } from 'node:fs';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

let bad = 0;
for (const path of process.argv.slice(2)) {
  const bytes = readFileSync(path);
  const { issues } = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 20 });
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  const gltf = await new GLTFLoader().parseAsync(buffer, '');
  let pieces = 0;
  gltf.scene.traverse((node) => (pieces += /^piece_\d+$/.test(node.name) && node.parent.name === 'z_up' ? 1 : 0));
  const tracks = gltf.animations[0]?.tracks.length ?? 0;
  console.log(`${path}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} notes; three.js: ${pieces} pieces, ${tracks} tracks; ${bytes.length} bytes`);
  for (const m of issues.messages.slice(0, 5)) console.log(`  ${m.code} ${m.message} ${m.pointer}`);
  bad += issues.numErrors + issues.numWarnings;
}
process.exit(bad ? 1 : 0);
