// SPDX-License-Identifier: MIT
// Tables and the sentences above them.
// Runs of before did not part a row's cost, nor measure it against its own component.
const allRows = [...results.mean, ...views.flatMap(view => view.techniques)];
const hasCost = allRows.every(row => row.cost), hasOwn = allRows.some(row => row.own);

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
  ...(hasCost ? [
    {key: "technique", title: "technique ms", hint: "GPU time of a frame beyond the base frame's: median, and the spread of the timed frames",
     digits: 2, of: r => r.cost.technique.ms, beside: r => `${fixed(r.cost.technique.low, 2)}\u2013${fixed(r.cost.technique.high, 2)}`,
     versus: true},
    {key: "base", title: "base ms", hint: "GPU time of the frame that every row begins with", digits: 2, of: r => r.cost.base.ms},
    {key: "preparation", title: "prepared in ms", hint: "once for each scene", digits: 1, of: r => r.cost.preparation, versus: true}] : []),
  ...(hasCost ? [] : [{key: "ms", title: "ms", hint: "GPU time of a frame", digits: 2, of: r => r.ms}]),
  {key: "memory", title: "MiB", hint: "GPU memory at its peak", digits: 1, of: r => r.memory_bytes / 1048576},
  ...(hasOwn ? [{key: "own", title: "own gain %", hint: "against direct light and what the row's techniques compute, as if that had been asked for",
    digits: 2, of: r => r.own ? r.own.gain : -Infinity, versus: true, shown: r => r.own ? fixed(r.own.gain, 2) : "\u2013",
    beside: r => r.own ? `${plusMinus(r.own.gain_error, 2)} of ${r.own.component}` : ""}] : []),
];

// "54.9 ± 0.1": the standard error that the reference's noise leaves.
const plusMinus = (error, digits) => "\u00b1\u00a0" + fixed(error, digits);

// A gain that the reference's noise could explain is shown gray, with a tilde.
function gainCell(row, isBaseline) {
  if (isBaseline) return make("td.gain", {}, "\u2013");
  if (row.unmeasured) return make("td.gain.hidden", {title: row.unmeasured}, row.unmeasured);
  const hidden = row.gain > 0 && !row.claimed;
  return make("td.gain." + (hidden || row.gain === 0 ? "hidden" : row.gain > 0 ? "up" : "down"),
              {title: "\u00b1 standard error by the reference's noise" + (hidden ? ": not claimed" : "")},
              (hidden ? "~" : row.gain > 0 ? "+" : "") + fixed(row.gain, 2),
              make("span.error", {}, " " + plusMinus(row.gain_error, 2)));
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
    if (c.key !== "base" && (row.unmeasured || (c.versus && i === 0))) return make("td", {}, "\u2013");
    const values = rows.map(c.of), value = c.of(row);
    const best = c.best && values.some(v => v !== values[0]) && value === c.best(...values);
    return make(best ? "td.best" : "td", {}, c.shown ? c.shown(row) : fixed(value, c.digits),
                c.beside && c.beside(row) ? make("span.error", {}, " " + c.beside(row)) : undefined);
  };
  return sortedTable(name, [{key: "label", title: "technique", of: ({row}) => row.label,
    cell: ({row, i}) => make("td.name", {title: JSON.stringify(row.parameters)}, dot(i), row.label)},
    ...columns.map(c => ({...c, of: ({row}) => c.of(row), cell: cellOf(c)}))], items, redraw);
}

// Of a mean gain over views: their references' noises are independent.
function errorOfMean(summary) {
  const row = labels.indexOf(summary.label);
  const errors = views.filter(v => summary.group === v.scene.group || !groups.includes(summary.group))
    .map(v => v.techniques[row].gain_error);
  return Math.hypot(...errors) / Math.max(errors.length, 1);
}

// What the views of each group say together.
function summaryTable(redraw) {
  const text = (key, title) => ({key, title, of: s => s[key], cell: s => make("td", {}, s[key])});
  const number = (key, title, digits, factor = 1, hint) => ({key, title, hint, of: s => s[key],
    cell: s => make("td", {}, fixed(factor * s[key], digits))});
  return sortedTable("summary", [text("group", "scenes"), text("label", "technique"), number("views", "views", 0),
    number("positive", "gain > 0 %", 1, 100, "share of views that are closer to the truth than direct light"),
    number("claimed", "claimed %", 1, 100, "share of views whose gain the reference's noise does not explain"),
    {key: "mean_gain", title: "mean gain %", hint: "\u00b1 standard error by the references' noise", of: s => s.mean_gain,
     cell: s => make("td", {}, fixed(s.mean_gain, 2), make("span.error", {}, " " + plusMinus(errorOfMean(s), 2)))},
    number("median_gain", "median gain %", 2),
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
    inScope(), redraw, view => ({class: "open", ...pressable(() => openView(views.indexOf(view))), role: undefined}));
}

function header() {
  const device = results.device.name.replace(/ \(.*/, "");
  const sizes = unique(views.map(v => v.size.join(" \u00d7 ")));
  const facts = [results.scenes.length > 1 ? plural(results.scenes.length, "scene") : undefined, plural(views.length, "view"),
                 sizes.join(" and "), "truth: " + results.component.replaceAll("+", " + ") + ", " + results.spp + " samples a pixel",
                 device].filter(fact => fact);
  return make("header", {}, themeButton(), make("div.eyebrow", {}, results.scenes.length > 1 ? "luxel experiment" : "luxel evaluation"),
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
  return make("p.verdict", {}, strong(best.label), " comes closest to the truth: ", strong(`${fixed(best.gain, 1)} ${plusMinus(best.gain_error, 1)} %`),
    " of direct light's error is gone on average" + spread + ", " + fixed(100 * best.improved, 1) +
    " % of the pixels are closer, at ", ...(hasCost ?
      [strong(fixed(best.cost.technique.ms, 1) + " ms"), ` beside the ${fixed(best.cost.base.ms, 1)} ms of the frame that it is built on.`] :
      [strong(fixed(best.ms, 1) + " ms"), ` a frame where direct light alone takes ${fixed(direct.ms, 1)} ms.`]));
}
