// SPDX-License-Identifier: MIT
// The address holds what is shown, by names, so that a link shows the same; the theme is the reader's own.
const named = {
  scope: {write: s => results.scenes[s] ? results.scenes[s].name : "all", read: t => t === "all" ? -1 : results.scenes.findIndex(s => s.name === t)},
  view: {write: i => views[i].title, read: t => views.findIndex(v => v.title === t)},
  row: {write: i => labels[i], read: t => labels.indexOf(t)},
  left: {write: i => nameOf(i), read: t => t === "reference" ? -1 : labels.indexOf(t)},
  right: {write: i => nameOf(i), read: t => t === "reference" ? -1 : labels.indexOf(t)},
};
const allowed = {
  metric: v => Object.hasOwn(metrics, v), quantity: v => Object.hasOwn(quantities, v), layout: v => v === "slider" || v === "two", kind: v => Object.hasOwn(kinds, v),
  stops: v => Math.abs(v) <= 4, zoom: v => v >= 1 && v <= 32, x: v => v >= 0 && v <= 1, y: v => v >= 0 && v <= 1, cut: v => v >= 0 && v <= 100,
  scope: v => v >= -1 && v < results.scenes.length, view: v => v in views, row: v => v in labels, left: v => v >= -1 && v < labels.length,
  right: v => v >= -1 && v < labels.length,
};

function address() {
  const parts = new URLSearchParams();
  for (const [key, value] of Object.entries(state))
    if (value !== defaults[key]) parts.set(key, named[key] ? named[key].write(value) : typeof value === "number" ? +value.toFixed(4) : value);
  return "#" + parts;
}
let remembered; // what the address says already
function remember() {
  const now = address();
  if (now === (location.hash || "#")) return;
  remembered = now;
  try { history.replaceState(null, "", now); } catch { location.replace(now); }
}
// State from the address; what it does not say is as at first. True if it names what the viewer shows, undefined if the
// page wrote it itself.
function recall() {
  if ((location.hash || "#") === remembered) return undefined;
  const parts = new URLSearchParams(location.hash.slice(1));
  Object.assign(state, defaults);
  for (const [key, text] of parts) {
    if (!Object.hasOwn(defaults, key)) continue;
    const missing = named[key] && text !== "all" && text !== "reference" && named[key].read(text) < 0;
    const value = named[key] ? named[key].read(text) : typeof defaults[key] === "number" ? parseFloat(text) : text;
    if (!missing && allowed[key](value)) state[key] = value;
  }
  return ["view", "left", "right", "layout", "kind", "stops", "zoom"].some(key => parts.has(key));
}

// Themes: the system's, or the other by a button.
const themes = ["auto", "light", "dark"];
function stored(theme) {
  try {
    if (theme) localStorage.setItem("luxel-theme", theme);
    return localStorage.getItem("luxel-theme");
  } catch { return theme || null; }
}
let theme = themes.includes(stored()) ? stored() : "auto";
function setTheme(name) {
  theme = name;
  if (name === "auto") delete document.documentElement.dataset.theme; else document.documentElement.dataset.theme = name;
}
setTheme(theme);
function themeButton() {
  const button = make("button.plain.theme", {type: "button", id: "theme", title: "light, dark, or as the system has it"});
  const say = () => { button.textContent = "Theme: " + theme; };
  button.addEventListener("click", () => {
    setTheme(themes[(themes.indexOf(theme) + 1) % themes.length]);
    stored(theme);
    say();
  });
  say();
  return button;
}
