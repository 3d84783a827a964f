// SPDX-License-Identifier: MIT
// The report's data and state.
// Text goes in as text nodes only: names come from scene files. Colors are the style sheet's, so that both themes have
// theirs.
const colorOf = i => `var(--series-${i % 8})`;

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
const between = (value, least, most) => Math.min(Math.max(value, least), most);
// What a keyboard can press as a mouse can click it.
const pressable = action => ({tabindex: 0, role: "button", onclick: action, onkeydown: event => {
  if (event.key !== "Enter" && event.key !== " ") return;
  event.preventDefault();
  action();
}});
const unique = values => [...new Set(values)];

// Every view with the scene that it is of.
const views = results.scenes.flatMap((scene, s) => scene.views.map((view, v) =>
  ({...view, scene, s, pictures: pictures[s][v], title: results.scenes.length > 1 ? `${scene.name}, ${view.name}` : view.name})));
const labels = results.mean.map(row => row.label);
const groups = unique(results.scenes.map(scene => scene.group));
const bestRow = results.mean.reduce((best, row, i) => row.delta < results.mean[best].delta ? i : best, 0);

// scope: -1 = all scenes, otherwise one. Left and right picture: -1 = reference, otherwise a row. The link to the page
// holds what differs from this (link.js).
const gainOf = view => view.techniques[bestRow].gain;
const state = {scope: -1, metric: "delta", quantity: "gain", row: Math.max(bestRow, Math.min(1, labels.length - 1)),
  view: views.reduce((best, v, i) => v.pictures && (!views[best].pictures || gainOf(v) > gainOf(views[best])) ? i : best, 0),
  left: -1, right: bestRow, layout: "slider", kind: "image", cut: 50, stops: 0, zoom: 1, x: .5, y: .5};
const defaults = {...state};
const inScope = () => views.filter(view => state.scope < 0 || view.s === state.scope);
const meansInScope = () => state.scope < 0 ? results.mean : results.scenes[state.scope].mean;
const scopeName = () => state.scope < 0 ? "all scenes" : results.scenes[state.scope].name;
