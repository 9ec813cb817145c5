// What the theme leaves out for keyboards and screen readers (axe: aria-required-attr, landmark-unique, scrollable-region-focusable).
addEventListener("load", () => {
  document.querySelectorAll("[role=heading]:not([aria-level])").forEach(part => part.setAttribute("aria-level", "2"));
  for (const [part, name] of [["sidebar", "All pages"], ["toc", "On this page"]])
    document.querySelector(`aside.${part}-drawer`)?.setAttribute("aria-label", name);
  document.querySelectorAll("pre, table, div.math, .table-wrapper").forEach(part => {
    if (part.scrollWidth > part.clientWidth) part.tabIndex = 0;
  });
});
