// Light or dark as the reader wants it, and tables that are wider than the page within reach of the keyboard.
(() => {
  const root = document.documentElement, dark = () => (root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches);
  // A browser may forbid a file to keep anything.
  const kept = (value) => { try { if (value) localStorage.setItem("brinell-theme", value); return localStorage.getItem("brinell-theme"); } catch { return null; } };
  if (kept()) root.dataset.theme = kept();
  const node = document.createElement("button");
  node.type = "button";
  node.className = "theme";
  const name = () => { node.textContent = dark() ? "Light page" : "Dark page"; };
  node.addEventListener("click", () => { root.dataset.theme = dark() ? "light" : "dark"; kept(root.dataset.theme); name(); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", name);
  name();
  document.querySelector("header").prepend(node);
  const reach = () => document.querySelectorAll(".scroll, pre").forEach((box) => {
    const wide = box.scrollWidth > box.clientWidth;
    box.classList.toggle("wider", wide);
    if (!wide) return ["tabindex", "role", "aria-label"].forEach((key) => box.removeAttribute(key));
    box.tabIndex = 0;
    box.setAttribute("role", "group");
    box.setAttribute("aria-label", box.closest("section")?.querySelector("h2")?.textContent || "Table");
  });
  reach();
  addEventListener("resize", reach);
  // On a phone what is looked up, and is long, stands folded.
  const long = ":is(#assumptions, #audits, #slip, #scenario) > :is(.scroll, pre)";
  if (matchMedia("(max-width: 700px)").matches) document.querySelectorAll(long).forEach((whole) => {
    if (whole.offsetHeight < 600) return;
    const fold = document.createElement("details"), name = document.createElement("summary"), rows = whole.querySelectorAll("tbody tr").length;
    name.textContent = rows ? `Table of ${rows} rows` : "Whole text";
    whole.replaceWith(fold);
    fold.append(name, whole);
  });
  // A link to what is folded opens it.
  const open = () => { const at = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1))); const folded = at && at.querySelector(":scope > details"); if (folded) folded.open = true; };
  open();
  addEventListener("hashchange", open);
  // Paper unfolds nothing.
  let opened = [];
  addEventListener("beforeprint", () => { opened = [...document.querySelectorAll("details:not([open])")]; opened.forEach((one) => { one.open = true; }); });
  addEventListener("afterprint", () => opened.forEach((one) => { one.open = false; }));
  document.querySelectorAll("details").forEach((one) => one.addEventListener("toggle", reach));
})();
