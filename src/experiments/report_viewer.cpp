// SPDX-License-Identifier: MIT
// The report's picture viewer, and the page put together.
#include "experiments/report.h"

namespace luxel {

std::string_view report_viewer() {
    return R"js(
// Begins with the view where the best technique gains most. Left and right: -1 = reference, otherwise a row.
// kind: image | error | change.
const bestRow = results.mean.reduce((best, row, i) => row.delta < results.mean[best].delta ? i : best, 0);
const gainOf = view => view.techniques[bestRow].gain;
const firstView = results.views.reduce((best, view, i) => gainOf(view) > gainOf(results.views[best]) ? i : best, 0);
const state = {view: firstView, left: -1, right: bestRow, layout: "slider", kind: "image", cut: 50};

const nameOf = i => i < 0 ? "reference" : results.mean[i].label;
function sourceOf(i) {
  const view = pictures[state.view];
  return i < 0 ? view.reference : view.rows[i][state.kind];
}

function choice(key, options) {
  return make("span.choice", {role: "group"}, ...options.map(([value, text, title]) =>
    make("button", {type: "button", title, "aria-pressed": state[key] === value,
      onclick: () => { state[key] = value; showViewer(); }}, text)));
}
function picker(key, text) {
  const select = make("select", {onchange: event => { state[key] = +event.target.value; showViewer(); }});
  for (let i = -1; i < results.mean.length; ++i) {
    const option = make("option", {value: i}, nameOf(i));
    option.selected = state[key] === i;
    select.append(option);
  }
  return make("label", {}, text, select);
}

const aspect = `--aspect:${results.size[0] / results.size[1]}`;
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
  return make("div.stage", {style: aspect}, ...photo(state.left, "left"), over, make("span.tag.right", {}, nameOf(state.right)),
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
  if (results.views.length < 2) return undefined;
  return make("div.strip", {}, ...results.views.map((view, i) =>
    make("button", {type: "button", "aria-pressed": state.view === i, title: view.name,
      onclick: () => { state.view = i; showViewer(); }},
      make("img", {src: pictures[i].reference, alt: ""}), make("span", {}, view.name))));
}

const viewer = make("div", {});
function showViewer() {
  const before = viewer.querySelector(".strip"), scrolled = before ? before.scrollLeft : 0;
  const view = results.views[state.view], reference = view.reference;
  const origin = reference.cached ? "taken from the cache" : `rendered in ${fixed(reference.seconds, 1)} s`;
  viewer.replaceChildren(...[strip(),
    make("div.bar", {}, choice("layout", [["slider", "Slider"], ["two", "Side by side"]]),
      choice("kind", [["image", "Picture"], ["error", "Error", "distance to the reference"],
                      ["change", "Closer or farther", "than direct light alone"]]),
      picker("left", "Left"), picker("right", "Right")),
    state.layout === "slider" ? slider() : sideBySide(), scale(),
    make("div.below", {}, table(view.techniques),
      make("p.hint", {style: "margin:10px 0 0"}, `${view.name}: reference of ${reference.spp} samples a pixel ${origin}, ` +
        `noise ${fixed(reference.noise, 5)} of delta, exposure ${(+view.exposure).toPrecision(4)}.`))].filter(e => e));
  const after = viewer.querySelector(".strip");
  if (after) after.scrollLeft = scrolled;
}

function conventions() {
  const entry = (term, ...text) => [make("dt", {}, term), make("dd", {}, ...text)];
  const list = Object.entries(results.frame).map(([key, value]) => `${key}=${value}`).join(", ");
  const environment = {none: "dropped on both sides", ambient: "true in the reference, an ambient term in the frame",
    lights: results.reference_lights === "same" ? "the same directional lights on both sides"
                                                : "true in the reference, directional lights in the frame"};
  return make("dl", {}, ...entry("Scene", results.scene), ...entry("Truth", `path traced on the CPU at pixel centers; light paths ` +
      `${results.component.replaceAll("+", " + ")}; ${results.spp} samples a pixel, seed ${results.seed}`),
    ...(results.ao ? entry("Accessibility", "1 = open; its nearest occluder within " + results.ao.radius + " m counts by " +
      `membership ${results.ao.membership}; every figure is of linear values in [0, 1]; the baseline is open everywhere`) : [
    ...entry("Display values", "delta, gain, rho, improved, PSNR, SSIM and FLIP: one exposure per view (98th percentile of the " +
      "reference's luminance to 1), clamped, sRGB curve"),
    ...entry("Radiance", "RMSE and relMSE: linear, not clamped")]),
    ...entry("Background", "left out of every figure"),
    ...entry("Noise", "delta between the reference's two sample halves, halved; a smaller gain is marked ~ and not claimed"),
    ...entry("Time", `GPU timestamps, median of ${results.timed_frames} frames after warm-up; maximum memory of images and buffers`),
    ...entry("Environment", environment[results.frame.environment] || results.frame.environment),
    ...entry("Frame", list),
    ...entry("Device", `${results.device.name}, ${results.device.driver}, Vulkan ${results.device.api_version}`),
    ...entry("luxel", results.luxel_version),
    ...(results.warnings.length ? entry("Warnings", ...results.warnings.map(w => make("div", {}, w))) : []));
}

const page = document.getElementById("page");
const many = results.mean.length > 1;
page.replaceChildren(...[header(), verdict(),
  section("Mean over all views", "Smaller is better for delta, RMSE, relMSE and FLIP; larger for the others. Best in bold. " +
    `Reference noise: ${fixed(results.mean_noise, 5)} of delta.`, table(results.mean)),
  make("div.pair", {},
    many ? section("Gain per view", "Percent of direct light's error that is gone. Pale: hidden by the reference's noise.",
                   gainChart(), legend(1)) : undefined,
    section("Error over time", "Down and to the left is better. Small dots: single views. Dashed: the reference's noise.",
            costChart(), legend(0))),
  section("Pictures", "Every picture of a view has the same exposure, set by its reference.", viewer),
  section("Time by pass", "GPU time in milliseconds, mean over views; the longest passes by name.", passChart()),
  section("How this was measured", "", conventions())].filter(e => e));
showViewer();
)js";
}

} // namespace luxel
