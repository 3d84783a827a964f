// SPDX-License-Identifier: MIT
// The report's picture viewer, and the page put together.
#include "experiments/report.h"

namespace luxel {

std::string_view report_viewer() {
    return R"js(
// kind: image | error | change.
const nameOf = i => i < 0 ? "reference" : labels[i];
function sourceOf(i) {
  const small = views[state.view].pictures;
  return i < 0 ? small.reference : small.rows[i][state.kind];
}

function choice(key, options) {
  return make("span.choice", {role: "group"}, ...options.map(([value, text, title]) =>
    make("button", {type: "button", title, "aria-pressed": state[key] === value,
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

const aspect = () => `--aspect:${views[state.view].size[0] / views[state.view].size[1]}`;
const photo = (i, side) => [make("img", {src: sourceOf(i), alt: nameOf(i)}), make("span.tag." + side, {}, nameOf(i))];

function slider() {
  const over = make("img.over", {src: sourceOf(state.right), alt: nameOf(state.right)});
  const handle = make("div.handle", {});
  const place = () => {
    over.style.clipPath = `inset(0 0 0 ${state.cut}%)`;
    handle.style.left = state.cut + "%";
  };
  const input = make("input", {type: "range", min: 0, max: 100, step: .1, value: state.cut, "aria-label": "border between the pictures",
    oninput: event => { state.cut = +event.target.value; place(); }});
  place();
  return make("div.stage", {style: aspect()}, ...photo(state.left, "left"), over, make("span.tag.right", {}, nameOf(state.right)),
              handle, input);
}
const sideBySide = () => make("div.two", {}, make("div.stage", {}, ...photo(state.left, "left")),
                              make("div.stage", {}, ...photo(state.right, "left")));

// The map's colors, as in pictures.cpp.
const scaleColors = {
  error: ["0", "#fff,#fccc7a,#ed6b40,#991c40,#1a081a", `${scales.error} or more`, "mean absolute difference of display values"],
  change: [`${scales.change} farther`, "#990d14,#f28c73,#fff,#7ab3f2,#0d3399", `${scales.change} closer`,
           "than direct light alone, in display values"]};
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
  const stage = view.pictures ? [
    make("div.bar", {}, choice("layout", [["slider", "Slider"], ["two", "Side by side"]]),
      choice("kind", [["image", "Picture"], ["error", "Error", "distance to the reference"],
                      ["change", "Closer or farther", "than direct light alone"]]),
      picker("left", "Left"), picker("right", "Right")),
    state.layout === "slider" ? slider() : sideBySide(), scale()] :
    [make("p.hint", {}, "This page holds no picture of this view.")];
  viewer.replaceChildren(...[strip(), make("h3", {id: "view-title"}, view.title), ...stage,
    make("div.below", {}, rowsTable("view", view.techniques, showViewer),
      make("p.hint", {style: "margin:10px 0 0"}, `${view.title}: ${view.size.join(" \u00d7 ")}, reference of ${reference.spp} ` +
        `samples a pixel ${origin}, noise ${fixed(reference.noise, 5)} of delta, exposure ${(+view.exposure).toPrecision(4)}.`))]
    .filter(e => e));
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

function conventions() {
  const entry = (term, ...text) => [make("dt", {}, term), make("dd", {}, ...text)];
  const listOf = frame => Object.entries(frame).map(([key, value]) => `${key}=${value}`).join(", ");
  const environment = frame => ({none: "dropped on both sides", ambient: "true in the reference, an ambient term in the frame",
    lights: results.reference_lights === "same" ? "the same directional lights on both sides"
                                                : "true in the reference, directional lights in the frame"})[frame.environment];
  const perScene = textOf => unique(results.scenes.map(textOf)).map(text => make("div", {}, text));
  const warnings = unique(results.scenes.flatMap(scene => scene.warnings));
  return make("dl", {}, ...entry(results.scenes.length > 1 ? "Scenes" : "Scene", ...perScene(scene => scene.source +
      (scene.environment ? ` under ${scene.environment} x ${scene.environment_scale}` : ""))),
    ...entry("Truth", `${results.judge === "povray" ? "POV-Ray's picture" : "path traced on the CPU"} at pixel centers; light ` +
      `paths ${results.component.replaceAll("+", " + ")}` + (results.judge === "povray" ? "; its noise is not known" :
      `; ${results.spp} samples a pixel, seed ${results.seed}`)),
    ...(results.ao ? entry("Accessibility", "1 = open; its nearest occluder within " + results.ao.radius + " m counts by " +
      `membership ${results.ao.membership}; every figure is of linear values in [0, 1]; the baseline is open everywhere`) : [
    ...entry("Display values", "delta, gain, rho, improved, PSNR, SSIM and FLIP: one exposure per view (98th percentile of the " +
      "reference's brightest channel to 1), clamped, sRGB curve"),
    ...entry("Radiance", "RMSE and relMSE: linear, not clamped")]),
    ...entry("Background", "left out of every figure"),
    ...entry("Noise", "delta between two halves of the reference's samples, halved; what it adds to delta, gain, rho, improved, " +
      "RMSE and relMSE is taken out; a gain below 1.96 of the standard error that it leaves is marked ~ and not claimed"),
    ...entry("Time", `GPU timestamps, median of ${results.timed_frames} frames after warm-up; maximum memory of images and buffers`),
    ...entry("Environment", ...perScene(scene => environment(scene.frame))),
    ...entry("Frame", ...perScene(scene => listOf(scene.frame))),
    ...entry("Device", `${results.device.name}, ${results.device.driver}, Vulkan ${results.device.api_version}`),
    ...entry("luxel", results.luxel_version),
    ...(results.missing ? entry("Unfinished", plural(results.missing, "view") + " left out") : []),
    ...(warnings.length ? entry("Warnings", ...warnings.map(w => make("div", {}, w))) : []));
}

function section(title, hint, ...children) {
  return make("section", {}, make("h2", {}, title), make("p.hint", {}, hint), ...children);
}
// A part of the page that is drawn again when the state changes.
const parts = [];
function part(draw) {
  const element = make("div.part", {});
  const redraw = () => element.replaceChildren(draw(redraw));
  parts.push(redraw);
  return element;
}
function select(key, text, options) {
  const list = make("select", {id: key, onchange: event => {
    state[key] = typeof state[key] === "number" ? +event.target.value : event.target.value;
    drawAll();
  }}, ...options.map(([value, name]) => make("option", {value}, name)));
  list.value = state[key];
  return make("label", {}, text, list);
}

function controls() {
  const all = [
    results.scenes.length > 1 ? select("scope", "Scene", [[-1, "all"], ...results.scenes.map((s, i) => [i, s.name])]
      .filter(([i]) => i < 0 || results.scenes[i].views.length)) : undefined,
    labels.length > 1 ? select("row", "Technique", labels.map((text, i) => [i, text]).slice(1)) : undefined,
    select("metric", "Error", Object.entries(metrics).map(([key, m]) => [key, m.name]))];
  return make("div.bar.controls", {}, ...all);
}

const drawAll = () => { parts.forEach(draw => draw()); showViewer(); };
const many = labels.length > 1;
const content = !views.length ? [header(), make("p.verdict", {}, "No view is finished.")] : [header(), verdict(), controls(),
  part(redraw => section(`Mean over the views of ${scopeName()}`, "Smaller is better for delta, RMSE, relMSE and FLIP; larger for " +
    `the others. Best in bold. Reference noise: ${fixed(results.mean_noise, 5)} of delta. A click on a head sorts.`,
    rowsTable("mean", meansInScope(), redraw))),
  many && views.length > 1 ? part(redraw => section("What all views say", "Groups of scenes, and all together.", summaryTable(redraw)))
                           : undefined,
  many ? part(() => section(`${quantities[state.quantity].name} of every view: ${labels[state.row]}`,
    quantities[state.quantity].hint + " From the least to the largest; pale: hidden by the reference's noise. A click opens the view.",
    make("div.bar", {}, select("quantity", "Show", Object.entries(quantities).map(([key, q]) => [key, q.name]))),
    gainChart(), groupLegend())) : undefined,
  part(() => section(`Error over time: ${scopeName()}`, "Down and to the left is better. Small dots: single views. Dashed: the " +
    "Pareto front; what lies above it is slower and no better than something on it.", costChart(), legend(0))),
  section("Pictures", "Every picture of a view has the same exposure, set by its reference.", viewer),
  views.length > 1 ? part(redraw => section(`Every view: ${labels[state.row]}`, "A click on a line opens the view, on a head sorts.",
    make("div.tall", {}, viewsTable(redraw)))) : undefined,
  part(() => section("Time by pass", "GPU time in milliseconds, mean over views; the longest passes by name.", passChart())),
  section("How this was measured", "", conventions())];
document.getElementById("page").replaceChildren(...content.filter(e => e));
if (views.length) drawAll();
)js";
}

} // namespace luxel
