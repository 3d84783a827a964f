// SPDX-License-Identifier: MIT
// The report's tables and charts. Text goes in as text nodes only: names come from scene files.
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
const scene = results.scene.split("/").pop();
const plural = (n, word) => n + " " + word + (n === 1 ? "" : "s");
const fixed = (value, digits) => value === null ? "\u221e" : value.toFixed(digits);

// A gain that the reference's noise could explain is shown gray, with a tilde.
function gainCell(row, isBaseline) {
  if (isBaseline) return make("td.gain", {}, "\u2013");
  const hidden = row.gain > 0 && !row.claimed;
  return make("td.gain." + (hidden || row.gain === 0 ? "hidden" : row.gain > 0 ? "up" : "down"),
              hidden ? {title: "smaller than the reference's own noise: not claimed"} : {},
              (hidden ? "~" : row.gain > 0 ? "+" : "") + fixed(row.gain, 2));
}

const columns = [
  {title: "delta", hint: "mean absolute error of display values", digits: 5, of: r => r.delta, best: Math.min},
  {title: "gain %", hint: "share of direct light's delta that is gone"},
  {title: "rho", hint: "correlation of luminance", digits: 4, of: r => r.rho, best: Math.max},
  {title: "improved %", hint: "pixels closer to the truth than direct light", digits: 2, of: r => 100 * r.improved,
   best: Math.max, versus: true},
  {title: "RMSE", hint: "of linear radiance", digits: 5, of: r => r.rmse, best: Math.min},
  {title: "relMSE", hint: "squared error over (reference\u00b2 + .01)", digits: 5, of: r => r.relmse, best: Math.min},
  {title: "PSNR", hint: "dB, display values", digits: 2, of: r => r.psnr === null ? Infinity : r.psnr, best: Math.max},
  {title: "SSIM", hint: "structural similarity", digits: 4, of: r => r.ssim, best: Math.max},
  {title: "FLIP", hint: "perceptual difference, mean", digits: 4, of: r => r.flip, best: Math.min},
  {title: "ms", hint: "GPU time of a frame", digits: 2, of: r => r.ms},
  {title: "MiB", hint: "GPU memory at its peak", digits: 1, of: r => r.memory_bytes / 1048576},
];

function table(rows) {
  const head = make("tr", {}, make("th", {}, "technique"), ...columns.map(c => make("th", {title: c.hint}, c.title)));
  const body = rows.map((row, i) => make("tr", {},
    make("td.name", {title: JSON.stringify(row.parameters)}, dot(i), row.label),
    ...columns.map(c => {
      if (!c.of) return gainCell(row, i === 0);
      if (c.versus && i === 0) return make("td", {}, "\u2013");
      const values = rows.map(c.of);
      const best = c.best && values.some(v => v !== values[0]) && c.of(row) === c.best(...values);
      const value = c.of(row);
      return make(best ? "td.best" : "td", {}, isFinite(value) ? value.toFixed(c.digits) : "\u221e");
    })));
  return make("div.scroll", {}, make("table", {}, make("thead", {}, head), make("tbody", {}, ...body)));
}

function header() {
  const device = results.device.name.replace(/ \(.*/, "");
  const facts = [plural(results.views.length, "view"), results.size.join(" \u00d7 "),
                 "truth: " + results.component.replaceAll("+", " + ") + ", " + results.spp + " samples a pixel", device];
  return make("header", {}, make("div.eyebrow", {}, "luxel evaluation"), make("h1", {title: results.scene}, scene),
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
                                 "than the reference's own noise (", fixed(results.mean_noise, 5), ").");
  const index = results.mean.indexOf(best);
  const gains = results.views.map(v => v.techniques[index].gain);
  const spread = gains.length > 1 ? " (" + fixed(Math.min(...gains), 1) + " to " + fixed(Math.max(...gains), 1) +
    " over the views)" : "";
  return make("p.verdict", {}, strong(best.label), " comes closest to the truth: ", strong(fixed(best.gain, 1) + " %"),
    " of direct light's error is gone on average" + spread + ", " + fixed(100 * best.improved, 1) +
    " % of the pixels are closer, at ", strong(fixed(best.ms, 1) + " ms"), " a frame where direct light alone takes " +
    fixed(direct.ms, 1) + " ms.");
}

// Round steps for an axis from `low` to `high`.
function ticks(low, high, count) {
  const raw = (high - low) / count || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].find(m => m * power >= raw) * power;
  const values = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + step * 1e-6; v += step) values.push(+v.toPrecision(12));
  return values;
}
const label = value => String(+value.toPrecision(6));

function gainChart() {
  const width = 560, height = 290, left = 46, right = 8, top = 12, bottom = 46;
  const rows = results.mean.map((_, i) => i).slice(1);
  const gains = results.views.flatMap(v => v.techniques.slice(1).map(t => t.gain));
  const marks = ticks(Math.min(0, ...gains), Math.max(0, ...gains) || 1, 5);
  const low = Math.min(marks[0], ...gains), high = Math.max(marks[marks.length - 1], ...gains);
  const y = v => top + (high - v) / (high - low) * (height - top - bottom);
  const group = (width - left - right) / results.views.length, bar = Math.min(group * .72 / rows.length, 46);
  const chart = make("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "gain per view"});
  for (const m of marks) chart.append(
    make("line", {x1: left, x2: width - right, y1: y(m), y2: y(m), stroke: m === 0 ? "#8b94a3" : "#e3e7ed"}),
    make("text", {x: left - 8, y: y(m) + 4, "text-anchor": "end"}, label(m)));
  const every = Math.ceil(results.views.length * 62 / (width - left - right));
  results.views.forEach((view, v) => {
    const center = left + group * (v + .5);
    rows.forEach((i, k) => {
      const t = view.techniques[i], x = center + (k - rows.length / 2) * bar;
      chart.append(make("rect", {x: x + bar * .06, width: bar * .88, y: Math.min(y(0), y(t.gain)),
        height: Math.max(Math.abs(y(t.gain) - y(0)), .5), rx: 2, fill: colorOf(i), opacity: t.claimed || t.gain < 0 ? 1 : .35},
        make("title", {}, `${view.name}, ${t.label}: ${fixed(t.gain, 2)} %`)));
    });
    const fits = Math.max(Math.floor(group * every / 6.6), 4);
    const name = view.name.length > fits ? view.name.slice(0, fits - 1) + "\u2026" : view.name;
    if (v % every === 0) chart.append(make("text", {x: center, y: height - bottom + 22, "text-anchor": "middle"}, name,
                                           make("title", {}, view.name)));
  });
  return chart;
}

function costChart() {
  const width = 560, height = 290, left = 60, right = 16, top = 12, bottom = 46;
  const points = results.mean.map((row, i) => ({row, i}));
  const all = results.views.flatMap(v => v.techniques.map((row, i) => ({row, i, view: v.name})));
  const xs = ticks(0, Math.max(...all.map(p => p.row.ms)) * 1.06 || 1, 6);
  const ys = ticks(0, Math.max(...all.map(p => p.row.delta)) * 1.06 || 1, 5);
  const most = {x: Math.max(xs[xs.length - 1], ...all.map(p => p.row.ms)),
                y: Math.max(ys[ys.length - 1], ...all.map(p => p.row.delta))};
  const x = v => left + v / most.x * (width - left - right), y = v => height - bottom - v / most.y * (height - top - bottom);
  const chart = make("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "error over time"});
  for (const m of ys) chart.append(make("line", {x1: left, x2: width - right, y1: y(m), y2: y(m), stroke: "#e3e7ed"}),
                                   make("text", {x: left - 8, y: y(m) + 4, "text-anchor": "end"}, label(m)));
  for (const m of xs) chart.append(make("text", {x: x(m), y: height - bottom + 20, "text-anchor": "middle"}, label(m)));
  chart.append(make("line", {x1: left, x2: width - right, y1: y(0), y2: y(0), stroke: "#8b94a3"}),
    make("text", {x: (left + width - right) / 2, y: height - 4, "text-anchor": "middle"}, "ms a frame"),
    make("text", {x: 12, y: top + (height - top - bottom) / 2, "text-anchor": "middle",
                  transform: `rotate(-90 12 ${top + (height - top - bottom) / 2})`}, "delta"));
  const noise = results.mean_noise;
  chart.append(make("line", {x1: left, x2: width - right, y1: y(noise), y2: y(noise), stroke: "#b3261e",
    "stroke-dasharray": "4 4"}, make("title", {}, "the reference's own noise: " + fixed(noise, 5))));
  for (const p of all) chart.append(make("circle", {cx: x(p.row.ms), cy: y(p.row.delta), r: 3, fill: colorOf(p.i), opacity: .3},
    make("title", {}, `${p.view}, ${p.row.label}: ${fixed(p.row.ms, 2)} ms, delta ${fixed(p.row.delta, 5)}`)));
  for (const p of points) chart.append(make("circle", {cx: x(p.row.ms), cy: y(p.row.delta), r: 6.5, fill: colorOf(p.i),
    stroke: "#fff", "stroke-width": 1.5}));
  // Each label takes the first place around its point that is free: beside it, else higher or lower.
  const taken = points.map(p => ({x: x(p.row.ms) - 7, y: y(p.row.delta) - 7, w: 14, h: 14}));
  const free = b => b.x >= left && b.x + b.w <= width && b.y >= 0 &&
    !taken.some(t => b.x < t.x + t.w && t.x < b.x + b.w && b.y < t.y + t.h && t.y < b.y + b.h);
  for (const p of points) {
    const w = p.row.label.length * 7, h = 15, px = x(p.row.ms), py = y(p.row.delta);
    const places = [0, -17, 17, -32, 32, -47, 47].flatMap(dy => [px + 11, px - 11 - w, px - w / 2].slice(0, dy ? 3 : 2)
      .map(bx => ({x: bx, y: py - h / 2 + dy, w, h})));
    const box = places.find(free) || places[0];
    taken.push(box);
    chart.append(make("text.strong", {x: box.x + w / 2, y: box.y + 12, "text-anchor": "middle", stroke: "#fff", "stroke-width": 3,
                                      "paint-order": "stroke", style: "fill:" + colorOf(p.i)}, p.row.label));
  }
  return chart;
}

// One bar per row, cut into its passes; thin slices are named by their tooltip and in the list.
function passChart() {
  const most = Math.max(...results.mean.map(r => r.ms), 1e-9);
  return make("div", {}, ...results.mean.map((row, i) => {
    const passes = row.passes.slice().sort((a, b) => b.ms - a.ms);
    const bar = make("svg", {viewBox: "0 0 1000 22", preserveAspectRatio: "none", style: "height:22px"});
    let x = 0;
    row.passes.forEach((p, k) => {
      const width = p.ms / most * 1000;
      bar.append(make("rect", {x, y: 0, width: Math.max(width, 0), height: 22, fill: colorOf(i), opacity: k % 2 ? .55 : .85},
                      make("title", {}, `${p.name}: ${fixed(p.ms, 3)} ms`)));
      x += width;
    });
    const list = passes.slice(0, 5).map(p => `${p.name} ${fixed(p.ms, 2)}`).join(" \u00b7 ");
    return make("div", {style: "margin-top:14px"}, make("div", {style: "display:flex;justify-content:space-between;gap:16px"},
      make("span.name", {}, dot(i), row.label), make("span", {}, fixed(row.ms, 2) + " ms")), bar,
      make("div.hint", {style: "margin:4px 0 0"}, list + (passes.length > 5 ? ` \u00b7 ${passes.length - 5} more` : "")));
  }));
}

const legend = first => make("div.legend", {}, ...results.mean.slice(first).map((row, i) =>
  make("span", {}, dot(i + first), row.label)));

function section(title, hint, ...children) {
  return make("section", {}, make("h2", {}, title), make("p.hint", {}, hint), ...children);
}
)js";
}

} // namespace luxel
