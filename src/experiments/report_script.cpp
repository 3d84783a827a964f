// SPDX-License-Identifier: MIT
// The report's data, state and tables. Text goes in as text nodes only: names come from scene files.
#include "experiments/report.h"

namespace luxel {

std::string_view report_script() {
    return R"js(
const colors = ["#8a93a1", "#2457d6", "#d9730d", "#12805c", "#8b3fc7", "#c2255c", "#0b87a5", "#7a6a00"];
const colorOf = i => colors[i % colors.length];

// Elements: make("td.best", {title: "..."}, child, "text").
function make(spec, attributes, ...children) {
  const [tag, ...classes] = spec.split(".");
  const svg = ["svg", "g", "rect", "line", "circle", "text", "title", "path"].includes(tag);
  const element = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  if (classes.length) element.setAttribute("class", classes.join(" "));
  for (const [key, value] of Object.entries(attributes || {}))
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (value !== undefined) element.setAttribute(key, value);
  element.append(...children.filter(child => child !== undefined));
  return element;
}
const dot = i => make("span.dot", {style: "background:" + colorOf(i)});
const plural = (n, word) => n + " " + word + (n === 1 ? "" : "s");
const fixed = (value, digits) => value === null || !isFinite(value) ? "\u221e" : value.toFixed(digits);
const unique = values => [...new Set(values)];

// Every view with the scene that it is of.
const views = results.scenes.flatMap((scene, s) => scene.views.map((view, v) =>
  ({...view, scene, s, pictures: pictures[s][v], title: results.scenes.length > 1 ? `${scene.name}, ${view.name}` : view.name})));
const labels = results.mean.map(row => row.label);
const groups = unique(results.scenes.map(scene => scene.group));
const bestRow = results.mean.reduce((best, row, i) => row.delta < results.mean[best].delta ? i : best, 0);

// scope: -1 = all scenes, otherwise one. Left and right picture: -1 = reference, otherwise a row.
const gainOf = view => view.techniques[bestRow].gain;
const state = {scope: -1, metric: "delta", quantity: "gain", row: Math.max(bestRow, Math.min(1, labels.length - 1)),
  view: views.reduce((best, v, i) => v.pictures && (!views[best].pictures || gainOf(v) > gainOf(views[best])) ? i : best, 0),
  left: -1, right: bestRow, layout: "slider", kind: "image", cut: 50};
const inScope = () => views.filter(view => state.scope < 0 || view.s === state.scope);
const meansInScope = () => state.scope < 0 ? results.mean : results.scenes[state.scope].mean;
const scopeName = () => state.scope < 0 ? "all scenes" : results.scenes[state.scope].name;

const psnrOf = row => row.psnr === null ? Infinity : row.psnr;
const columns = [
  {key: "delta", title: "delta", hint: "mean absolute error of display values", digits: 5, of: r => r.delta, best: Math.min},
  {key: "gain", title: "gain %", hint: "share of direct light's delta that is gone", of: r => r.gain},
  {key: "rho", title: "rho", hint: "correlation of luminance", digits: 4, of: r => r.rho, best: Math.max},
  {key: "improved", title: "improved %", hint: "pixels closer to the truth than direct light", digits: 2,
   of: r => 100 * r.improved, best: Math.max, versus: true},
  {key: "rmse", title: "RMSE", hint: "of linear radiance", digits: 5, of: r => r.rmse, best: Math.min},
  {key: "relmse", title: "relMSE", hint: "squared error over (reference\u00b2 + .01)", digits: 5, of: r => r.relmse, best: Math.min},
  {key: "psnr", title: "PSNR", hint: "dB, display values", digits: 2, of: psnrOf, best: Math.max},
  {key: "ssim", title: "SSIM", hint: "structural similarity", digits: 4, of: r => r.ssim, best: Math.max},
  {key: "flip", title: "FLIP", hint: "perceptual difference, mean", digits: 4, of: r => r.flip, best: Math.min},
  {key: "ms", title: "ms", hint: "GPU time of a frame", digits: 2, of: r => r.ms},
  {key: "memory", title: "MiB", hint: "GPU memory at its peak", digits: 1, of: r => r.memory_bytes / 1048576},
];

// A gain that the reference's noise could explain is shown gray, with a tilde.
function gainCell(row, isBaseline) {
  if (isBaseline) return make("td.gain", {}, "\u2013");
  const hidden = row.gain > 0 && !row.claimed;
  return make("td.gain." + (hidden || row.gain === 0 ? "hidden" : row.gain > 0 ? "up" : "down"),
              {title: `\u00b1 ${fixed(row.gain_error, 2)}, standard error by the reference's noise` + (hidden ? ": not claimed" : "")},
              (hidden ? "~" : row.gain > 0 ? "+" : "") + fixed(row.gain, 2));
}

// A table whose head sorts it: the first click brings the smallest up, the second the largest.
// columns: {key, title, hint, of(item), cell(item)}.
const sorting = {};
function sortedTable(name, all, items, redraw, rowAttributes = () => ({})) {
  const order = sorting[name], column = order && all.find(c => c.key === order.key);
  const rows = items.slice();
  if (column) rows.sort((a, b) => {
    const x = column.of(a), y = column.of(b);
    return (typeof x === "string" ? x.localeCompare(y) : x - y) * order.sign;
  });
  const sort = c => { sorting[name] = {key: c.key, sign: order && order.key === c.key ? -order.sign : 1}; redraw(); };
  const mark = c => column !== c ? "none" : order.sign > 0 ? "ascending" : "descending";
  const head = make("tr", {}, ...all.map(c => make("th", {title: c.hint, "aria-sort": mark(c)},
    make("button.sort", {type: "button", onclick: () => sort(c)}, c.title, column === c ? (order.sign > 0 ? " \u25b4" : " \u25be") : ""))));
  return make("div.scroll", {}, make("table", {"data-name": name}, make("thead", {}, head),
    make("tbody", {}, ...rows.map(item => make("tr", rowAttributes(item), ...all.map(c => c.cell(item)))))));
}

// Rows of techniques, the baseline first.
function rowsTable(name, rows, redraw) {
  const items = rows.map((row, i) => ({row, i}));
  const cellOf = c => ({row, i}) => {
    if (c.key === "gain") return gainCell(row, i === 0);
    if (c.versus && i === 0) return make("td", {}, "\u2013");
    const values = rows.map(c.of), value = c.of(row);
    const best = c.best && values.some(v => v !== values[0]) && value === c.best(...values);
    return make(best ? "td.best" : "td", {}, fixed(value, c.digits));
  };
  return sortedTable(name, [{key: "label", title: "technique", of: ({row}) => row.label,
    cell: ({row, i}) => make("td.name", {title: JSON.stringify(row.parameters)}, dot(i), row.label)},
    ...columns.map(c => ({...c, of: ({row}) => c.of(row), cell: cellOf(c)}))], items, redraw);
}

// What the views of each group say together.
function summaryTable(redraw) {
  const text = (key, title) => ({key, title, of: s => s[key], cell: s => make("td", {}, s[key])});
  const number = (key, title, digits, factor = 1, hint) => ({key, title, hint, of: s => s[key],
    cell: s => make("td", {}, fixed(factor * s[key], digits))});
  return sortedTable("summary", [text("group", "scenes"), text("label", "technique"), number("views", "views", 0),
    number("positive", "gain > 0 %", 1, 100, "share of views that are closer to the truth than direct light"),
    number("claimed", "claimed %", 1, 100, "share of views whose gain the reference's noise does not explain"),
    number("mean_gain", "mean gain %", 2), number("median_gain", "median gain %", 2),
    number("rho_before", "rho before", 4), number("rho_after", "rho after", 4),
    number("improved", "improved %", 2, 100, "mean share of pixels that came closer"), number("tied", "tied %", 2, 100)],
    results.summary, redraw);
}

// One technique over all views; a click opens the view.
function viewsTable(redraw) {
  const rowOf = view => view.techniques[state.row];
  return sortedTable("views", [
    {key: "title", title: "view", of: v => v.title, cell: v => make("td.name", {}, v.title)},
    {key: "size", title: "size", of: v => v.size[0] * v.size[1], cell: v => make("td", {}, v.size.join(" \u00d7 "))},
    ...columns.map(c => ({...c, of: v => c.of(rowOf(v)),
      cell: v => c.key === "gain" ? gainCell(rowOf(v), state.row === 0) : make("td", {}, fixed(c.of(rowOf(v)), c.digits))})),
    {key: "noise", title: "noise", hint: "of the reference, in delta", of: v => v.reference.noise,
     cell: v => make("td", {}, fixed(v.reference.noise, 5))}],
    inScope(), redraw, view => ({class: "open", onclick: () => openView(views.indexOf(view))}));
}

function header() {
  const device = results.device.name.replace(/ \(.*/, "");
  const sizes = unique(views.map(v => v.size.join(" \u00d7 ")));
  const facts = [results.scenes.length > 1 ? plural(results.scenes.length, "scene") : undefined, plural(views.length, "view"),
                 sizes.join(" and "), "truth: " + results.component.replaceAll("+", " + ") + ", " + results.spp + " samples a pixel",
                 device].filter(fact => fact);
  return make("header", {}, make("div.eyebrow", {}, results.scenes.length > 1 ? "luxel experiment" : "luxel evaluation"),
              make("h1", {title: results.name}, results.name.split("/").pop()),
              make("p.facts", {}, ...facts.map(f => make("span", {}, f))));
}

// The question the report answers, in a sentence or two.
function verdict() {
  const direct = results.mean[0];
  const others = results.mean.slice(1).sort((a, b) => a.delta - b.delta);
  if (!others.length) return make("p.verdict", {}, "Direct light alone misses the truth by delta ",
                                  make("b", {}, fixed(direct.delta, 4)), ".");
  const best = others[0], strong = text => make("b", {}, text);
  if (!best.claimed) return make("p.verdict", {}, "No technique comes closer to the truth than direct light alone by more ",
                                 "than the reference's noise could explain.");
  const gains = views.map(v => v.techniques[results.mean.indexOf(best)].gain);
  const spread = gains.length > 1 ? " (" + fixed(Math.min(...gains), 1) + " to " + fixed(Math.max(...gains), 1) +
    " over the views)" : "";
  return make("p.verdict", {}, strong(best.label), " comes closest to the truth: ", strong(fixed(best.gain, 1) + " %"),
    " of direct light's error is gone on average" + spread + ", " + fixed(100 * best.improved, 1) +
    " % of the pixels are closer, at ", strong(fixed(best.ms, 1) + " ms"), " a frame where direct light alone takes " +
    fixed(direct.ms, 1) + " ms.");
}
)js";
}

} // namespace luxel
