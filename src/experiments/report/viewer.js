// SPDX-License-Identifier: MIT
// The picture viewer's controls around its stages.
const kinds = {
  image: ["Picture"], error: ["Error", "distance to the reference"],
  signed: ["Too dark or bright", "signed difference to the reference"],
  flip: ["FLIP", "the difference that an eye sees between alternating pictures"],
  change: ["Closer or farther", "than direct light alone"]};
const nameOf = i => i < 0 ? "reference" : labels[i];

function choice(key, options) {
  return make("span.choice", {role: "group", "data-key": key}, ...options.map(([value, text, title]) =>
    make("button", {type: "button", title, "aria-pressed": state[key] === value, "data-value": value,
      onclick: () => { state[key] = value; showViewer(); }}, text)));
}
function picker(key, text) {
  const select = make("select", {onchange: event => { state[key] = +event.target.value; showViewer(); }});
  for (let i = -1; i < labels.length; ++i) {
    const option = make("option", {value: i}, nameOf(i));
    option.selected = state[key] === i;
    select.append(option);
  }
  return make("label", {}, text, select);
}

// Stops of exposure beside the view's own: factors of two.
function exposure() {
  const text = () => (state.stops > 0 ? "+" : "") + fixed(state.stops, 1) + " EV", shown = make("output", {}, text());
  const input = make("input", {type: "range", id: "stops", min: -4, max: 4, step: .1, value: state.stops, "aria-label": "exposure",
    oninput: event => { state.stops = +event.target.value; shown.textContent = text(); expose(); remember(); }});
  return make("label.exposure", {title: "0 is the exposure of every figure; a double click resets",
    ondblclick: () => { state.stops = 0; showViewer(); }}, "Exposure", input, shown);
}

// The maps' colors, as in pictures.cpp.
const diverging = "#990d14,#f28c73,#fff,#7ab3f2,#0d3399";
const scaleColors = {
  error: ["0", "#fff,#fccc7a,#ed6b40,#991c40,#1a081a", `${scales.error} or more`, "mean absolute difference of display values"],
  signed: [`${scales.signed} brighter`, diverging, `${scales.signed} darker`, "than the reference, in display values"],
  flip: ["0", "#fff,#fccc7a,#ed6b40,#991c40,#1a081a", `${scales.flip} or more`, "FLIP, of 67 pixels per degree"],
  change: [`${scales.change} farther`, diverging, `${scales.change} closer`, "than direct light alone, in display values"]};
function scale() {
  const colors = scaleColors[state.kind];
  if (!colors) return undefined;
  return make("p.scale", {}, colors[0], make("i", {style: `background:linear-gradient(90deg,${colors[1]})`}), colors[2],
              make("span", {}, "\u2013 " + colors[3]));
}

function strip() {
  const shown = views.map((view, i) => ({view, i})).filter(({view, i}) => view.pictures && (i === state.view ||
    state.scope < 0 || view.s === state.scope));
  if (shown.length < 2) return undefined;
  return make("div.strip", {}, ...shown.map(({view, i}) =>
    make("button", {type: "button", "aria-pressed": state.view === i, title: view.title,
      onclick: () => { state.view = i; showViewer(); }},
      make("img", {src: view.pictures.reference, alt: "", loading: "lazy"}), make("span", {}, view.title))));
}

const viewer = make("div", {id: "viewer"});
function showViewer() {
  const before = viewer.querySelector(".strip"), scrolled = before ? before.scrollLeft : 0;
  const view = views[state.view], reference = view.reference;
  const origin = reference.cached ? "taken from the cache" : `rendered in ${fixed(reference.seconds, 1)} s`;
  const has = kind => kind === "image" || view.pictures.rows.some(row => row[kind]);
  if (view.pictures && !has(state.kind)) state.kind = "image";
  const stage = view.pictures ? [
    make("div.bar", {}, choice("layout", [["slider", "Slider"], ["two", "Side by side"]]),
      choice("kind", Object.entries(kinds).filter(([kind]) => has(kind)).map(([kind, text]) => [kind, ...text])),
      picker("left", "Left"), picker("right", "Right")),
    make("div.bar", {}, zoomButtons(), state.kind === "image" ? exposure() : undefined,
      make("span.hint", {}, "Ctrl and wheel, two fingers, + and \u2212 zoom; drag and arrows move; 0 resets.")),
    state.layout === "slider" ? slider() : sideBySide(), scale()] :
    [make("p.hint", {}, "This page holds no picture of this view.")];
  viewer.replaceChildren(...[strip(), make("h3", {id: "view-title"}, view.title), ...stage,
    make("div.below", {}, rowsTable("view", view.techniques, showViewer),
      make("p.hint.after", {}, `${view.title}: ${view.partial ? "stopped before its end; " : ""}${view.size.join(" \u00d7 ")}, reference of ${reference.spp} ` +
        `samples a pixel ${origin}, noise ${fixed(reference.noise, 5)} of delta, exposure ${(+view.exposure).toPrecision(4)}.`))]
    .filter(e => e));
  moveLayers();
  expose();
  remember();
  const after = viewer.querySelector(".strip");
  if (!after) return;
  after.scrollLeft = scrolled;
  const pressed = after.querySelector("[aria-pressed=true]");
  if (pressed && (pressed.offsetLeft < scrolled || pressed.offsetLeft > scrolled + after.clientWidth - pressed.clientWidth))
    after.scrollLeft = pressed.offsetLeft - after.clientWidth / 2;
}
function openView(i) {
  state.view = i;
  showViewer();
  viewer.scrollIntoView({block: "start"});
}
