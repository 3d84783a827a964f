// SPDX-License-Identifier: MIT
// Charts: gains of every view, error over time, time by pass.
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
const meanOf = values => values.reduce((a, b) => a + b, 0) / values.length;
function medianOf(values) {
  const sorted = values.slice().sort((a, b) => a - b), middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

// What a bar says of a view [Rohleder2010, fig. 5.8 to 5.10].
const quantities = {
  gain: {name: "Gain", unit: " %", digits: 2, of: v => v.techniques[state.row].gain, error: v => v.techniques[state.row].gain_error || 0,
         hint: "Percent of direct light's error that is gone; whiskers: one standard error by the reference's noise."},
  delta: {name: "Error removed", unit: "", digits: 5, of: v => v.techniques[0].delta - v.techniques[state.row].delta, error: () => 0,
          hint: "Direct light's delta minus the technique's."},
  rho: {name: "Correlation gained", unit: "", digits: 5, of: v => v.techniques[state.row].rho - v.techniques[0].rho, error: () => 0,
        hint: "The technique's rho minus direct light's."},
};

// Charts are drawn for the width that they have, so that their text keeps its size on a phone.
const chartWidth = () => between(document.getElementById("page").clientWidth - (innerWidth > 640 ? 48 : 30), 260, 1132);
const isNarrow = width => width < 620;
const cut = (text, width) => text.length * 6.8 <= width ? text : text.slice(0, Math.max(Math.floor(width / 6.8) - 1, 1)) + "\u2026";
const newChart = (id, width, height, title) => make("svg.chart", {viewBox: `0 0 ${width} ${height}`, width, height, role: "img",
  "aria-label": title, id});

// A bar for every view, from the least to the largest; its whisker is the standard error.
function gainChart() {
  const width = chartWidth(), narrow = isNarrow(width), height = 300, left = narrow ? 44 : 58, right = narrow ? 8 : 92, top = 16,
        bottom = 26;
  const quantity = quantities[state.quantity];
  const bars = inScope().map(view => ({view, value: quantity.of(view), error: quantity.error(view)})).sort((a, b) => a.value - b.value);
  const values = bars.map(b => b.value);
  const reach = bars.flatMap(b => [b.value - b.error, b.value + b.error]);
  const marks = ticks(Math.min(0, ...reach), Math.max(0, ...reach) || 1, 5);
  const low = Math.min(marks[0], ...reach), high = Math.max(marks[marks.length - 1], ...reach);
  const y = v => top + (high - v) / (high - low) * (height - top - bottom);
  const step = (width - left - right) / bars.length, bar = Math.min(step * .84, 46);
  const chart = newChart("gains", width, height, `${quantity.name} of every view`);
  for (const m of marks) chart.append(
    make(m === 0 ? "line.zero" : "line.grid", {x1: left, x2: width - right, y1: y(m), y2: y(m)}),
    make("text", {x: left - 8, y: y(m) + 4, "text-anchor": "end"}, label(m)));
  bars.forEach(({view, value, error}, i) => {
    const row = view.techniques[state.row], shown = row.claimed || value < 0 ? 1 : .35, middle = left + step * (i + .5);
    const said = `${view.title}: ${fixed(value, quantity.digits)}${error ? " " + plusMinus(error, quantity.digits) : ""}${quantity.unit}`;
    chart.append(make("rect.bar", {x: middle - bar / 2, width: bar, y: Math.min(y(0), y(value)),
      height: Math.max(Math.abs(y(value) - y(0)), .5), style: `fill:${colorOf(groups.indexOf(view.scene.group) + 1)}`, opacity: shown,
      ...pressable(() => openView(views.indexOf(view))), "aria-label": said}, make("title", {}, said)));
    if (error && step > 5) chart.append(make("path.whisker", {d: `M${middle} ${y(value - error)}V${y(value + error)}` +
      `M${middle - 3} ${y(value - error)}h6M${middle - 3} ${y(value + error)}h6`}));
    if (step > 70) chart.append(make("text", {x: middle, y: height - 8, "text-anchor": "middle"}, cut(view.title, step)));
  });
  // In a narrow chart the lines' names stand inside, where bars are low.
  const level = (value, name, kind, above) => chart.append(
    make("line.level." + kind, {x1: left, x2: width - right, y1: y(value), y2: y(value)}),
    make("text.halo", narrow ? {x: left + 4, y: y(value) + (above ? -4 : 13)}
                             : {x: width - right + 6, y: y(value) + (above ? -2 : 12)},
         name + " " + fixed(value, state.quantity === "gain" ? 2 : 4)));
  if (bars.length > 1) {
    const mean = meanOf(values), median = medianOf(values);
    level(mean, "mean", "solid", mean >= median);
    level(median, "median", "dashed", mean < median);
  }
  return chart;
}
const groupLegend = () => make("div.legend", {}, ...groups.map((group, i) =>
  make("span", {}, make("span.dot", {style: "background:" + colorOf(i + 1)}), group)));

// Errors: smaller is better.
const metrics = {
  delta: {name: "delta", of: r => r.delta}, rmse: {name: "RMSE", of: r => r.rmse}, relmse: {name: "relMSE", of: r => r.relmse},
  flip: {name: "FLIP", of: r => r.flip}, ssim: {name: "1 \u2212 SSIM", of: r => 1 - r.ssim},
};

// The rows that no other beats in both error and time, by time.
function paretoFront(points) {
  const front = [];
  for (const p of points.slice().sort((a, b) => a.x - b.x || a.y - b.y))
    if (!front.length || p.y < front[front.length - 1].y) front.push(p);
  return front;
}

function costChart() {
  const width = chartWidth(), narrow = isNarrow(width), height = 400, left = narrow ? 58 : 66, right = narrow ? 10 : 30, top = 14,
        bottom = 46, metric = metrics[state.metric];
  // A picture that was read has no time of its own.
  const timed = row => row.name !== "image" && !row.unmeasured;
  const points = meansInScope().map((row, i) => ({row, x: row.ms, y: metric.of(row), i, text: row.label})).filter(p => timed(p.row));
  const all = inScope().flatMap(view => view.techniques.map((row, i) =>
    ({row, x: row.ms, y: metric.of(row), i, text: `${view.title}, ${row.label}`}))).filter(p => timed(p.row));
  // Single views show where they fit; the axes are the means'.
  const few = all.length <= 400 ? all : [];
  const reach = values => Math.max(...values) * 1.06 || 1;
  const most = {x: reach([...few, ...points].map(p => p.x)), y: reach([...few, ...points].map(p => p.y))};
  const xs = ticks(0, most.x, narrow ? 4 : 8), ys = ticks(0, most.y, 5);
  const x = v => left + v / most.x * (width - left - right), y = v => height - bottom - v / most.y * (height - top - bottom);
  const chart = newChart("cost", width, height, "error over time");
  for (const m of ys) chart.append(make(m === 0 ? "line.zero" : "line.grid", {x1: left, x2: width - right, y1: y(m), y2: y(m)}),
                                   make("text", {x: left - 8, y: y(m) + 4, "text-anchor": "end"}, label(m)));
  for (const m of xs) chart.append(make("text", {x: x(m), y: height - bottom + 20, "text-anchor": "middle"}, label(m)));
  chart.append(make("text", {x: (left + width - right) / 2, y: height - 4, "text-anchor": "middle"}, "ms a frame"),
    make("text.axis", {x: 12, y: top + (height - top - bottom) / 2, "text-anchor": "middle",
                       transform: `rotate(-90 12 ${top + (height - top - bottom) / 2})`}, metric.name));
  const tip = p => make("title", {}, `${p.text}: ${fixed(p.x, 2)} ms, ${metric.name} ${fixed(p.y, 5)}`);
  for (const p of few) chart.append(make("circle", {cx: x(p.x), cy: y(p.y), r: 3, style: "fill:" + colorOf(p.i), opacity: .3}, tip(p)));

  // The front as stairs: between two of its rows the faster one is the best there is.
  const front = paretoFront(points);
  const stairs = front.map((p, k) => k ? `H${x(p.x)}V${y(p.y)}` : `M${x(p.x)} ${y(p.y)}`).join("");
  chart.append(make("path.front", {d: stairs + `H${width - right}`}));
  for (const p of points) chart.append(make("circle.point", {cx: x(p.x), cy: y(p.y), r: 6.5, style: "fill:" + colorOf(p.i),
                                            "data-label": p.text}, tip(p)));

  // Each label takes the first place around its point that is free: beside it, else higher or lower. Where
  // there are many rows only the front's are named.
  const taken = points.map(p => ({x: x(p.x) - 7, y: y(p.y) - 7, w: 14, h: 14}));
  const free = b => b.x >= left && b.x + b.w <= width && b.y >= 0 &&
    !taken.some(t => b.x < t.x + t.w && t.x < b.x + b.w && b.y < t.y + t.h && t.y < b.y + b.h);
  for (const p of points.length > 12 ? front : points) {
    const named = cut(p.text, narrow ? 130 : 400), w = named.length * 7, h = 15, px = x(p.x), py = y(p.y);
    const places = [0, -17, 17, -32, 32, -47, 47].flatMap(dy => [px + 11, px - 11 - w, px - w / 2].slice(0, dy ? 3 : 2)
      .map(bx => ({x: bx, y: py - h / 2 + dy, w, h})));
    const box = places.find(free) || places[0];
    taken.push(box);
    chart.append(make("text.strong.halo", {x: box.x + w / 2, y: box.y + 12, "text-anchor": "middle",
                                           style: "fill:" + colorOf(p.i)}, named));
  }
  return chart;
}

// One bar per row, cut into its passes; thin slices are named by their tooltip and in the list.
function passChart() {
  const rows = meansInScope().filter(row => row.name !== "image"), most = Math.max(...rows.map(r => r.ms), 1e-9);
  return make("div", {}, ...rows.map(row => {
    const i = labels.indexOf(row.label);
    const passes = row.passes.slice().sort((a, b) => b.ms - a.ms);
    const bar = make("svg", {viewBox: "0 0 1000 22", preserveAspectRatio: "none", style: "height:22px", role: "img",
                             "aria-label": `time by pass of ${row.label}`});
    let x = 0;
    row.passes.forEach((p, k) => {
      const width = p.ms / most * 1000;
      bar.append(make("rect", {x, y: 0, width: Math.max(width, 0), height: 22, style: "fill:" + colorOf(i), opacity: k % 2 ? .55 : .85},
                      make("title", {}, `${p.name}: ${fixed(p.ms, 3)} ms`)));
      x += width;
    });
    const list = passes.slice(0, 5).map(p => `${p.name} ${fixed(p.ms, 2)}`).join(" \u00b7 ");
    return make("div", {style: "margin-top:14px"}, make("div.row", {},
      make("span.name", {}, dot(i), row.label), make("span", {}, fixed(row.ms, 2) + " ms")), bar,
      make("div.hint", {style: "margin:4px 0 0"}, list + (passes.length > 5 ? ` \u00b7 ${passes.length - 5} more` : "")));
  }));
}

const legend = first => make("div.legend", {}, ...labels.slice(first).map((text, i) => make("span", {}, dot(i + first), text)));

// A chart as a file of its own: what the style sheet says of each element is written into it.
const kept = ["fill", "stroke", "stroke-width", "stroke-dasharray", "font-family", "font-size", "font-weight", "paint-order", "opacity"];
function svgText(chart) {
  const copy = chart.cloneNode(true), from = [chart, ...chart.querySelectorAll("*")], to = [copy, ...copy.querySelectorAll("*")];
  from.forEach((element, i) => {
    const style = getComputedStyle(element);
    to[i].removeAttribute("style");
    to[i].removeAttribute("class");
    for (const name of kept) if (style.getPropertyValue(name)) to[i].setAttribute(name, style.getPropertyValue(name));
  });
  const paper = make("rect", {width: "100%", height: "100%",
                              fill: getComputedStyle(document.documentElement).getPropertyValue("--paper").trim()});
  copy.insertBefore(paper, copy.firstChild);
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  return new XMLSerializer().serializeToString(copy);
}
function withSave(chart) {
  const save = () => {
    const url = URL.createObjectURL(new Blob([svgText(chart)], {type: "image/svg+xml"}));
    make("a", {href: url, download: `${chart.id}.svg`}).click();
    setTimeout(() => URL.revokeObjectURL(url), 1000);
  };
  return make("div.saved", {}, chart, make("button.plain.save", {type: "button", onclick: save,
    "aria-label": `Save the chart '${chart.getAttribute("aria-label")}' as SVG`}, "Save SVG"));
}
