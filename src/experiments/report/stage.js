// SPDX-License-Identifier: MIT
// Stages: two pictures of a view under one border or side by side, that zoom, move and are exposed together.
function sourceOf(i) {
  const small = views[state.view].pictures;
  return i < 0 ? small.reference : small.rows[i][state.kind];
}
// The reference has no map: it stands beside those of the rows as the picture that it is.
const brightOf = i => i < 0 ? views[state.view].pictures.reference_bright : views[state.view].pictures.rows[i].bright;

// A picture that fills its stage; what is above white in it is in a second, darker one.
function layer(i, kind) {
  const img = make("img", {src: sourceOf(i), alt: nameOf(i), draggable: "false"});
  return make("div.layer." + kind, {"data-picture": i}, img);
}
const aspect = () => `--aspect:${views[state.view].size[0] / views[state.view].size[1]}`;

// (state.x, state.y) of the picture, in [0, 1]^2, is at the center of every stage.
function moveLayers() {
  const half = .5 / state.zoom;
  state.x = between(state.x, half, 1 - half), state.y = between(state.y, half, 1 - half);
  for (const element of viewer.querySelectorAll(".layer")) {
    element.style.transform = `translate(${(.5 - state.x) * state.zoom * 100}%, ${(.5 - state.y) * state.zoom * 100}%) scale(${state.zoom})`;
    element.classList.toggle("near", state.zoom >= 3);
  }
  // A finger scrolls the page up and down over a whole picture, and moves one that is larger than its stage.
  for (const stage of viewer.querySelectorAll(".stage")) stage.style.touchAction = state.zoom > 1 ? "none" : "pan-y";
  const text = viewer.querySelector("#zoom");
  if (text) text.textContent = fixed(state.zoom, 1) + " \u00d7";
}
// About a point of the stage, in [0, 1]^2: what is there stays there.
function zoomBy(factor, x = .5, y = .5) {
  const zoom = between(state.zoom * factor, 1, 32);
  state.x += (x - .5) * (1 / state.zoom - 1 / zoom);
  state.y += (y - .5) * (1 / state.zoom - 1 / zoom);
  state.zoom = zoom;
  moveLayers();
  remember();
}
function pan(dx, dy) { // in stages
  state.x -= dx / state.zoom, state.y -= dy / state.zoom;
  moveLayers();
  remember();
}
function zoomButtons() {
  const button = (text, name, action) => make("button.plain", {type: "button", "aria-label": name, title: name, onclick: action}, text);
  return make("span.zoom", {role: "group", "aria-label": "zoom"}, button("\u2212", "zoom out", () => zoomBy(1 / 1.5)),
    make("output", {id: "zoom"}), button("+", "zoom in", () => zoomBy(1.5)), button("1:1", "whole picture", () => zoomBy(0)));
}

// Fingers and mouse: one moves the picture (or the border, where the whole picture shows), two zoom.
function movable(stage, moveBorder) {
  const down = new Map();
  let onBorder = false;
  const at = event => {
    const box = stage.getBoundingClientRect();
    return {x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height};
  };
  const spread = () => { const [a, b] = [...down.values()]; return Math.hypot(a.x - b.x, a.y - b.y) || 1e-6; };
  stage.addEventListener("pointerdown", event => {
    stage.setPointerCapture(event.pointerId);
    down.set(event.pointerId, at(event));
    onBorder = moveBorder && down.size === 1 && (state.zoom === 1 || event.target.closest(".handle") !== null);
    if (onBorder) moveBorder(at(event).x);
  });
  stage.addEventListener("pointermove", event => {
    const before = down.get(event.pointerId), now = at(event);
    if (!before) return;
    if (down.size === 2) {
      const wide = spread();
      down.set(event.pointerId, now);
      const [a, b] = [...down.values()];
      return zoomBy(spread() / wide, (a.x + b.x) / 2, (a.y + b.y) / 2);
    }
    down.set(event.pointerId, now);
    if (onBorder) moveBorder(now.x); else pan(now.x - before.x, now.y - before.y);
  });
  for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, event => down.delete(event.pointerId));
  stage.addEventListener("wheel", event => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const place = at(event);
    zoomBy(2 ** (-event.deltaY / 240), place.x, place.y);
  }, {passive: false});
  stage.addEventListener("keydown", event => {
    const arrows = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    if (event.key === "+" || event.key === "=") zoomBy(1.5);
    else if (event.key === "-") zoomBy(1 / 1.5);
    else if (event.key === "0") zoomBy(0);
    else if (arrows[event.key] && event.target === stage && state.zoom > 1) pan(.1 * arrows[event.key][0], .1 * arrows[event.key][1]);
    else if (arrows[event.key] && moveBorder && arrows[event.key][0]) moveBorder(state.cut / 100 - .01 * arrows[event.key][0]);
    else return;
    event.preventDefault();
  });
  return stage;
}
const keys = {tabindex: 0, role: "group"};

function slider() {
  const over = make("div.clip", {}, layer(state.right, "over"));
  const handle = make("div.handle", {tabindex: 0, role: "slider", "aria-label": "border between the pictures", "aria-valuemin": 0,
                                     "aria-valuemax": 100});
  const moveBorder = x => {
    state.cut = between(100 * x, 0, 100);
    over.style.clipPath = `inset(0 0 0 ${state.cut}%)`;
    handle.style.left = state.cut + "%";
    handle.setAttribute("aria-valuenow", Math.round(state.cut));
  };
  moveBorder(state.cut / 100);
  return movable(make("div.stage", {...keys, style: aspect(), "aria-label": `${nameOf(state.left)} and ${nameOf(state.right)}`},
    layer(state.left, "under"), over, make("span.tag.left", {}, nameOf(state.left)), make("span.tag.right", {}, nameOf(state.right)),
    handle), moveBorder);
}
const sideBySide = () => make("div.two", {}, ...[state.left, state.right].map(i => movable(make("div.stage",
  {...keys, style: aspect(), "aria-label": nameOf(i)}, layer(i, "under"), make("span.tag.left", {}, nameOf(i))))));

// Display values back to radiance over white, times 2^stops, and forth again. Above white the bright picture takes over.
const decode = v => v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4;
const encode = v => v <= .0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - .055;
const exposed = (value, factor) => Math.round(255 * encode(between(value * factor, 0, 1)));
function exposedPixels(shown, bright, factor) {
  const plain = new Uint8ClampedArray(256), high = new Uint8ClampedArray(256);
  for (let v = 0; v < 256; ++v) plain[v] = exposed(decode(v / 255), factor), high[v] = exposed(decode(v / 255) * scales.bright, factor);
  for (let k = 0; k < shown.length; ++k)
    if (k % 4 !== 3) shown[k] = bright && shown[k] >= 250 && high[bright[k]] >= plain[250] ? high[bright[k]] : plain[shown[k]];
}
async function pixelsOf(source, width, height) {
  const img = new Image();
  img.src = source;
  await img.decode();
  const canvas = make("canvas", {width: width || img.naturalWidth, height: height || img.naturalHeight});
  const context = canvas.getContext("2d", {willReadFrequently: true});
  context.drawImage(img, 0, 0, canvas.width, canvas.height);
  return {canvas, context, data: context.getImageData(0, 0, canvas.width, canvas.height)};
}
let exposing = 0; // the latest call; an earlier one that ends later must not win
async function expose() {
  const mine = ++exposing, plain = state.stops === 0 || state.kind !== "image";
  for (const element of viewer.querySelectorAll(".layer")) {
    const old = element.querySelector("canvas"), i = +element.dataset.picture;
    if (plain) { if (old) old.remove(); continue; }
    const shown = await pixelsOf(sourceOf(i)), {width, height} = shown.canvas;
    const bright = brightOf(i) ? await pixelsOf(brightOf(i), width, height) : undefined;
    if (mine !== exposing) return;
    exposedPixels(shown.data.data, bright && bright.data.data, 2 ** state.stops);
    shown.context.putImageData(shown.data, 0, 0);
    if (old) old.remove();
    element.append(shown.canvas);
  }
}
