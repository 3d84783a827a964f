// SPDX-License-Identifier: MIT
// A report in a real browser, from the file system: a script clicks through it and says what it saw. Skipped
// where there is no Chromium.
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
  for (const button of [...document.querySelectorAll("#viewer .choice button")].map((_, i) => i))
    document.querySelectorAll("#viewer .choice button")[button].click();
  expect("a map with its scale", document.querySelectorAll("#viewer .scale").length === 1);
  expect("pictures side by side", document.querySelectorAll("#viewer .two img").length === 2);
} catch (error) { wrong.push(error.stack); }
Promise.all([...document.querySelectorAll("#viewer .two img")].map(i => i.decode())).catch(e => wrong.push("picture: " + e))
  .finally(() => document.body.append(make("pre", {id: "verdict"}, wrong.length ? wrong.join("; ") : "all is well")));
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
    page.insert(page.find("<style>"), watch);
    page.insert(page.find("</body>"), click_through);
    spill(folder.path() / "clicked.html", page);
    const std::filesystem::path dump = folder.path() / "dump.html";
    const std::string command =
        browser + " --headless --no-sandbox --disable-gpu --user-data-dir='" +
        (folder.path() / "profile").string() + "' --virtual-time-budget=20000 --dump-dom 'file://" +
        (folder.path() / "clicked.html").string() + "' >'" + dump.string() + "' 2>/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;

    const std::string seen = slurp(dump);
    const std::string mark = "<pre id=\"verdict\">";
    const std::size_t begin = seen.rfind(mark);
    ASSERT_NE(begin, std::string::npos) << "the script did not come to its end";
    EXPECT_EQ(seen.substr(begin + mark.size(), seen.find("</pre>", begin) - begin - mark.size()),
              "all is well");
}

} // namespace
} // namespace luxel::testing
