// SPDX-License-Identifier: MIT
// How it was measured, and the page put together.
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
    ...(results.interrupted ? entry("Stopped", "before its end: what is here is of the views, rows and samples that were done") : []),
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
const lists = {}; // by what they choose: a link may choose it, too
function select(key, text, options) {
  const list = make("select", {id: key, onchange: event => {
    state[key] = typeof state[key] === "number" ? +event.target.value : event.target.value;
    drawAll();
  }}, ...options.map(([value, name]) => make("option", {value}, name)));
  list.value = state[key];
  lists[key] = list;
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

const drawAll = () => {
  for (const [key, list] of Object.entries(lists)) list.value = state[key];
  parts.forEach(draw => draw());
  showViewer();
};
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
    withSave(gainChart()), groupLegend())) : undefined,
  part(() => section(`Error over time: ${scopeName()}`, "Down and to the left is better. Small dots: single views. Dashed: the " +
    "Pareto front; what lies above it is slower and no better than something on it.", withSave(costChart()), legend(0))),
  section("Pictures", "Every picture of a view has the same exposure, set by its reference.", viewer),
  views.length > 1 ? part(redraw => section(`Every view: ${labels[state.row]}`, "A click on a line opens the view, on a head sorts.",
    make("div.tall", {}, viewsTable(redraw)))) : undefined,
  part(() => section("Time by pass", "GPU time in milliseconds, mean over views; the longest passes by name.", passChart())),
  section("How this was measured", "", conventions())];
document.getElementById("page").replaceChildren(...content.filter(e => e));
if (views.length) {
  const opensView = recall();
  drawAll();
  if (opensView) viewer.scrollIntoView({block: "start"});
  addEventListener("hashchange", () => { if (recall() !== undefined) drawAll(); });
  let width = innerWidth;
  addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; drawAll(); } });
}
