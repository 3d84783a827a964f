// SPDX-License-Identifier: MIT
// A report in a real browser, from the file system, on a screen and on a phone: a script clicks through it
// and says what it saw. Skipped where there is no Chromium.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "support/luxel_process.h"

namespace luxel::testing {
namespace {

std::string chromium() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
        if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0) return name;
    return {};
}

// Before the page's own script: whatever goes wrong is noted.
constexpr const char* watch = R"js(<script>
const wrong = [];
window.addEventListener("error", e => wrong.push(e.message));
window.addEventListener("unhandledrejection", e => wrong.push(String(e.reason)));
for (const level of ["error", "warn"]) console[level] = (...text) => wrong.push(text.join(" "));
</script>
)js";

// Behind it: every kind of control is used, and each must change what it is there to change.
constexpr const char* click_through = R"js(<script>
const find = what => document.querySelector(what) || wrong.push("there is no " + what);
const text = what => [...document.querySelectorAll(what)].map(e => e.textContent);
const expect = (what, condition) => { if (!condition) wrong.push("not so: " + what); };
function pick(id, value) {
  const list = find("#" + id);
  list.value = value;
  expect(id + " has " + value, list.value === String(value));
  list.dispatchEvent(new Event("change"));
}
try {
  expect("two scenes", results.scenes.length === 2 && views.length === 3);
  expect("a bar for every view", document.querySelectorAll("#gains rect").length === 3);
  const values = [...document.querySelectorAll("#gains rect title")].map(t => parseFloat(t.textContent.split(": ")[1]));
  expect("bars are sorted", values.every((v, i) => !i || values[i - 1] <= v));
  expect("a point for every row", document.querySelectorAll("#cost .point").length === 3);
  expect("a front", document.querySelectorAll("#cost .front").length === 1);

  const before = find("#cost").outerHTML;
  pick("metric", "rmse");
  expect("the metric changes the chart", find("#cost").outerHTML !== before && find("#cost .axis").textContent === "RMSE");
  pick("quantity", "rho");
  expect("the quantity changes the bars", text("h2").some(t => t.startsWith("Correlation gained")));
  pick("scope", 1);
  expect("one scene has fewer bars", document.querySelectorAll("#gains rect").length === results.scenes[1].views.length);
  expect("its means are shown", text("table[data-name=mean] tbody tr:first-child td")[1] === results.scenes[1].mean[0].delta.toFixed(5));
  pick("scope", -1);
  pick("row", 2);
  expect("the technique is named", text("h2").some(t => t.endsWith(labels[2])));

  const column = name => text(`table[data-name=${name}] tbody tr td:nth-child(2)`).map(parseFloat);
  const head = () => find("table[data-name=mean] th:nth-child(2) button");
  head().click();
  const up = column("mean");
  expect("sorted up", up.every((v, i) => !i || up[i - 1] <= v));
  head().click();
  expect("sorted down", String(column("mean")) === String(up.slice().reverse()));

  find("table[data-name=views] tbody tr:last-child").click();
  const opened = find("#view-title").textContent;
  expect("the line's view is open", opened === text("table[data-name=views] tbody tr:last-child td")[0]);
  find("#gains rect").dispatchEvent(new MouseEvent("click", {bubbles: true}));
  expect("the bar's view is open", find("#gains rect title").textContent.startsWith(find("#view-title").textContent));
  for (const key of ["layout", "kind"])
    for (const value of [...document.querySelectorAll(`.choice[data-key=${key}] button`)].map(b => b.dataset.value)) {
      find(`.choice[data-key=${key}] button[data-value=${value}]`).click();
      expect(`${key} is ${value}`, state[key] === value);
      if (key === "kind" && value !== "image") expect(`the map ${value} has its scale`, document.querySelectorAll("#viewer .scale").length === 1);
    }
  expect("five kinds of pictures", document.querySelectorAll(".choice[data-key=kind] button").length === 5);
  expect("pictures side by side", document.querySelectorAll("#viewer .two img").length === 2);
  expect("every picture is in the page", [...document.images].every(i => i.src.startsWith("data:image/")));

  // Every gain has its error beside it, in tables, and charts have whiskers.
  const gains = [...document.querySelectorAll("td.gain")].filter(cell => cell.textContent !== "\u2013");
  expect("gains have errors", gains.length >= 7 && gains.every(cell => / \u00b1\u00a0\d/.test(cell.textContent)));
  expect("the verdict has its error", /\u00b1/.test(find(".verdict").textContent));
  const meanGains = text("table[data-name=summary] tbody tr td:nth-child(6)");
  expect("mean gains have errors", meanGains.length >= 2 && meanGains.every(t => /\u00b1/.test(t)));

  // Both pictures zoom and move as one; what is under the pointer stays there.
  find("[aria-label='zoom in']").click();
  const moved = () => [...document.querySelectorAll("#viewer .layer")].map(l => l.style.transform);
  expect("zoomed alike", state.zoom === 1.5 && moved().length === 2 && moved()[0] === moved()[1] && moved()[0].includes("scale(1.5)"));
  zoomBy(1e9, .5, .5);
  expect("zoom ends", state.zoom === 32);
  zoomBy(0);
  const there = s => state.x + (s - .5) / state.zoom, place = there(.8);
  zoomBy(4, .8, .3);
  expect("the pointer's place stays", Math.abs(there(.8) - place) < 1e-9);
  pan(100, 100);
  expect("panning ends at the border", state.x === .5 / 4 && state.y === .5 / 4);
  const stage = find("#viewer .stage"), press = key => stage.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
  const x = state.x;
  press("ArrowRight");
  expect("arrows move a zoomed picture", state.x > x);
  press("0");
  expect("0 shows all", state.zoom === 1 && state.x === .5);
  press("+");
  expect("+ zooms", state.zoom === 1.5);
  find("#gains rect.bar").dispatchEvent(new KeyboardEvent("keydown", {key: "Enter", bubbles: true}));
  expect("a bar opens by Enter", find("#gains rect title").textContent.startsWith(find("#view-title").textContent));
  find(".choice[data-key=layout] button[data-value=slider]").click();
  find(".handle").dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowRight", bubbles: true}));
  expect("the border moves by keys", state.cut === 51 && find(".clip").style.clipPath.includes("51%"));

  // The link holds it all: scene, view, row, mode; and it shows the same again.
  pick("scope", 1); pick("row", 1);
  openView(2);
  find(".choice[data-key=kind] button[data-value=flip]").click();
  const link = location.hash, parts = new URLSearchParams(link.slice(1));
  expect("the link names scene and view", parts.get("scope") === results.scenes[1].name && parts.get("view") === views[2].title);
  expect("the link names row and mode", parts.get("row") === labels[1] && parts.get("kind") === "flip");
  const there2 = JSON.stringify(state);
  Object.assign(state, defaults);
  remembered = undefined;
  expect("a link opens the viewer", recall() === true);
  drawAll();
  expect("a link shows the same", JSON.stringify({...state, x: 0, y: 0}) === JSON.stringify({...JSON.parse(there2), x: 0, y: 0}));
  expect("lists follow the link", find("#scope").value === "1" && find("#row").value === "1");
  location.hash = "#view=nowhere&row=none&kind=what&zoom=99&stops=x&constructor=1";
  remembered = undefined;
  recall();
  expect("a wrong link is left alone", JSON.stringify(state) === JSON.stringify(defaults));
  drawAll();

  // Charts: their text keeps its size, and as files they are whole.
  for (const chart of document.querySelectorAll("svg.chart")) {
    const sizes = [...chart.querySelectorAll("text")].map(t => parseFloat(getComputedStyle(t).fontSize) *
      chart.getBoundingClientRect().width / chart.viewBox.baseVal.width);
    expect(`text of ${chart.id} has at least 11 pixels: ${Math.min(...sizes)}`, sizes.length > 3 && Math.min(...sizes) >= 11);
    const file = new DOMParser().parseFromString(svgText(chart), "image/svg+xml");
    expect(`${chart.id} is a file`, !file.querySelector("parsererror") && file.documentElement.getAttribute("width") > 200 &&
      [...file.querySelectorAll("*")].every(e => !/var\(|url\(|class=/.test(e.cloneNode(false).outerHTML)));
    expect(`${chart.id} keeps its colors`, new Set([...file.querySelectorAll("rect, circle")].map(e => e.getAttribute("fill"))).size > 1);
  }
  expect("charts can be saved", document.querySelectorAll("button.save").length === 2);
  expect("the page is as wide as the window", document.documentElement.scrollWidth <= innerWidth);

  // Themes.
  const paper = () => getComputedStyle(find("section")).backgroundColor;
  setTheme("light");
  const light = paper();
  setTheme("dark");
  expect("dark is dark", light === "rgb(255, 255, 255)" && paper() !== light);
  find("#theme").click();
  expect("the button names the theme", find("#theme").textContent === "Theme: " + theme);
} catch (error) { wrong.push(error.stack); }
// Exposure: a stop more is twice the light, in every pixel that is not cut off; above white the bright picture knows on.
async function exposure_is_right() {
  const gray = v => new Uint8ClampedArray([v, v, v, 255]), seen = (v, b, factor) => {
    const pixel = gray(v);
    exposedPixels(pixel, b === undefined ? undefined : gray(b), factor);
    return pixel[0];
  };
  expect("no stop changes nothing", [0, 1, 17, 100, 200, 249].every(v => seen(v, undefined, 1) === v));
  expect("a stop doubles", Math.abs(seen(100, undefined, 2) - 255 * encode(2 * decode(100 / 255))) <= .5);
  const eight = Math.round(255 * encode(8 / scales.bright)); // 8 times white
  expect("light above white comes back", Math.abs(decode(seen(255, eight, 1 / 16) / 255) - .5) < .01);
  openView(views.findIndex(v => v.pictures));
  state.layout = "two"; state.kind = "image"; state.stops = -1; state.left = 0;
  showViewer();
  await expose();
  const canvas = [...document.querySelectorAll("#viewer .layer canvas")];
  expect("both pictures are exposed", canvas.length === 2);
  const before = await pixelsOf(sourceOf(0)), after = canvas[0].getContext("2d").getImageData(0, 0, canvas[0].width, canvas[0].height);
  const mean = data => data.reduce((sum, v, i) => sum + (i % 4 === 3 || before.data.data[i] >= 250 ? 0 : decode(v / 255)), 0);
  expect("half the light", Math.abs(mean(after.data) / mean(before.data.data) - .5) < .01);
}
exposure_is_right().then(() => Promise.all([...document.querySelectorAll("#viewer .two img")].map(i => i.decode())))
  .catch(e => wrong.push("picture: " + (e.stack || e))).finally(() => document.body.append(make("pre", {id: "verdict"}, wrong.length ? wrong.join("; ") : "all is well")));
</script>
)js";

TEST(Report, ClicksThroughInABrowser) {
    const std::string browser = chromium();
    if (browser.empty()) GTEST_SKIP() << "no Chromium on this machine";
    TemporaryFolder folder;
    const std::filesystem::path experiment = folder.add("small.toml", std::string(R"toml(
size = "64x48"
frames = 1
[truth]
spp = 4
[[technique]]
use = "isr"
sweep = { samples = [8, 24] }
[[scene]]
source = "builtin:cornell"
[[scene]]
source = "builtin:shapes-point"
[[scene.views]]
count = 2
)toml"));
    const ProcessResult run = run_luxel(
        {"experiment", experiment.string(), "--no-cache", "--quiet", "-o", (folder.path() / "out").string()});
    ASSERT_EQ(run.code, 0) << run.error;

    std::string page = slurp(folder.path() / "out" / "report.html");
    EXPECT_EQ(page.find("http://", page.find("<body>")), page.find("http://www.w3.org/2000/svg"));
    page.insert(page.find("<style>"), watch);
    page.insert(page.find("</body>"), click_through);
    spill(folder.path() / "clicked.html", page);
    for (const char* size : {"1280,900", "500,900"}) { // a headless window is never narrower than 500
        SCOPED_TRACE(size);
        const std::filesystem::path dump = folder.path() / "dump.html";
        const std::string command =
            browser + " --headless --no-sandbox --disable-gpu --window-size=" + size + " --user-data-dir='" +
            (folder.path() / "profile").string() + "' --virtual-time-budget=20000 --dump-dom 'file://" +
            (folder.path() / "clicked.html").string() + "' >'" + dump.string() + "' 2>/dev/null";
        // Pictures are decoded beside the browser's virtual time, which a busy machine can let run out: once
        // more then.
        const std::string mark = "<pre id=\"verdict\">";
        std::string seen;
        std::size_t begin = std::string::npos;
        for (int tries = 0; begin == std::string::npos && tries < 5; ++tries) {
            ASSERT_EQ(std::system(command.c_str()), 0) << command;
            seen = slurp(dump);
            begin = seen.rfind(mark);
        }
        ASSERT_NE(begin, std::string::npos) << "the script did not come to its end";
        EXPECT_EQ(seen.substr(begin + mark.size(), seen.find("</pre>", begin) - begin - mark.size()),
                  "all is well");
    }
}

} // namespace
} // namespace luxel::testing
