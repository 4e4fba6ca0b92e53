// SPDX-License-Identifier: MIT
// Draws the formulas of a page by KaTeX, from this folder. Only pages with formulas load this file.
(() => {
  const here = document.currentScript.src.replace(/[^/]*$/, "katex/");
  const style = document.createElement("link");
  style.rel = "stylesheet";
  style.href = here + "katex.min.css";
  document.head.append(style);
  const load = (name, then) => {
    const script = document.createElement("script");
    script.src = here + name;
    script.onload = then;
    document.head.append(script);
  };
  const draw = () => document.querySelectorAll(".math").forEach((formula) => renderMathInElement(formula, {
    delimiters: [{left: "\\(", right: "\\)", display: false}, {left: "\\[", right: "\\]", display: true}],
  }));
  const begin = () => load("katex.min.js", () => load("contrib/auto-render.js", draw));
  if (document.readyState === "loading") addEventListener("DOMContentLoaded", begin); else begin();
})();
