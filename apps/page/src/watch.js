// SPDX-License-Identifier: MIT
// Reload on save: asks sunder view once a second whether the scene or a file of it was saved.

/// Calls `changed()` when a file of the scene is another than when it was last asked about, and
/// `gone(words)` when the program no longer answers; then asks no more.
export function watchFiles(engine, { changed, gone }) {
  let known = null;
  const ask = async () => {
    try {
      const { stamp } = await engine.ask('stamp');
      if (known !== null && stamp !== known) changed();
      known = stamp;
    } catch (error) {
      return gone(error.message);
    }
    setTimeout(ask, 1000);
  };
  ask();
}
