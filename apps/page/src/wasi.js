// SPDX-License-Identifier: MIT
// The few system calls that the engine's C library asks for: it has a clock, messages, no files.

/// Imports for an instance whose memory `memory()` gives; `say(text)` gets what it prints.
export function wasiImports(memory, say) {
  const refused = 52; // ENOSYS: there is nothing of the kind
  const bad = 8; // EBADF
  const view = () => new DataView(memory().buffer);
  const calls = {
    clock_time_get(clock, precision, at) {
      view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    environ_sizes_get(count, size) {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return 0;
    },
    environ_get: () => 0,
    random_get(at, size) {
      new Uint8Array(memory().buffer, at, size).fill(7); // hashes of tables only; always the same
      return 0;
    },
    fd_write(file, parts, count, written) {
      let size = 0;
      for (let i = 0; i < count; ++i) {
        const at = view().getUint32(parts + 8 * i, true);
        const length = view().getUint32(parts + 8 * i + 4, true);
        say(new TextDecoder().decode(new Uint8Array(memory().buffer, at, length).slice()));
        size += length;
      }
      view().setUint32(written, size, true);
      return 0;
    },
    fd_prestat_get: () => bad,
    proc_exit(code) {
      throw new Error(`the engine ended itself with code ${code}`);
    },
  };
  return new Proxy(calls, { get: (known, name) => known[name] ?? (() => refused) });
}
