// SPDX-License-Identifier: MIT
// The report's look.
#include "experiments/report.h"

namespace luxel {

std::string_view report_style() {
    return R"css(
:root {
  --ink: #1b1f26; --soft: #5b6472; --faint: #8b94a3; --line: #e3e7ed; --paper: #ffffff; --ground: #f5f6f8;
  --accent: #2457d6; --good: #12805c; --bad: #b3261e;
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 15px/1.5 system-ui, -apple-system, "Segoe UI",
  Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 40px 24px 64px; }
h1 { font-size: 30px; line-height: 1.2; font-weight: 650; letter-spacing: -.015em; margin: 4px 0 10px;
  overflow-wrap: anywhere; }
h2 { font-size: 17px; font-weight: 650; margin: 0 0 4px; }
.eyebrow { color: var(--accent); font-size: 12.5px; font-weight: 650; letter-spacing: .08em; text-transform: uppercase; }
.facts { display: flex; flex-wrap: wrap; gap: 6px 18px; color: var(--soft); font-size: 13.5px; margin: 0; padding: 0; }
.facts span + span::before { content: "\00b7"; margin-right: 18px; color: var(--faint); }
.verdict { font-size: 19px; line-height: 1.45; margin: 24px 0 26px; max-width: 56em; }
.verdict b { font-weight: 650; }
section { background: var(--paper); border: 1px solid var(--line); border-radius: 10px; padding: 20px 22px 22px;
  margin-top: 18px; }
.hint { color: var(--soft); font-size: 13px; margin: 0 0 14px; max-width: 70em; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 440px), 1fr)); gap: 18px; margin-top: 18px; }
.pair section { margin-top: 0; }
.scroll { overflow-x: auto; }
.tall .scroll { max-height: 560px; overflow-y: auto; }
.tall thead th { position: sticky; top: 0; background: var(--paper); }
button.sort { all: unset; cursor: pointer; } button.sort:focus-visible { outline: 2px solid var(--accent); }
tr.open { cursor: pointer; } tr.open:hover td { background: #f2f5fb; }
rect.bar { cursor: pointer; } rect.bar:hover { stroke: var(--ink); }
h3 { font-size: 15px; font-weight: 600; margin: 0 0 10px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 7px 0 7px 18px; white-space: nowrap; }
th { color: var(--soft); font-weight: 550; font-size: 12.5px; border-bottom: 1px solid var(--line); }
td { border-bottom: 1px solid #eff1f5; }
tr:last-child td { border-bottom: 0; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
td.best { font-weight: 680; }
td.gain.up { color: var(--good); } td.gain.down { color: var(--bad); } td.gain.hidden { color: var(--faint); }
.dot { display: inline-block; width: 10px; height: 10px; border-radius: 3px; margin-right: 9px; }
.name { font-weight: 560; }
svg { display: block; width: 100%; height: auto; overflow: visible; }
svg text { font-size: 12px; fill: var(--soft); }
svg text.strong { fill: var(--ink); font-weight: 560; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 18px; font-size: 13px; color: var(--soft); margin-top: 8px; }
.strip { display: flex; gap: 8px; overflow-x: auto; padding: 3px; margin: 0 -3px 14px; }
.strip button { flex: none; width: 124px; padding: 0; border: 2px solid transparent; border-radius: 8px; background: none;
  cursor: pointer; color: var(--soft); font: inherit; font-size: 12px; overflow: hidden; }
.strip img { display: block; width: 100%; aspect-ratio: 4 / 3; object-fit: cover; border-radius: 6px; }
.strip span { display: block; padding: 3px 4px; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.strip button[aria-pressed=true] { border-color: var(--accent); color: var(--ink); }
.bar { display: flex; flex-wrap: wrap; align-items: center; gap: 10px 16px; margin-bottom: 12px; }
.controls { position: sticky; top: 0; z-index: 2; background: var(--ground); padding: 10px 0; margin: 0; }
.bar label { font-size: 13px; color: var(--soft); display: flex; align-items: center; gap: 7px; }
select { font: inherit; font-size: 14px; padding: 5px 8px; border: 1px solid #cfd5de; border-radius: 7px; background: #fff;
  color: var(--ink); max-width: 260px; }
.choice { display: inline-flex; border: 1px solid #cfd5de; border-radius: 7px; overflow: hidden; }
.choice button { font: inherit; font-size: 13.5px; border: 0; padding: 5px 13px; background: #fff; color: var(--soft);
  cursor: pointer; }
.choice button + button { border-left: 1px solid #cfd5de; }
.choice button[aria-pressed=true] { background: var(--accent); color: #fff; }
.stage { position: relative; line-height: 0; border-radius: 8px; overflow: hidden; background: #e9ecf0;
  max-width: calc(78vh * var(--aspect)); margin: 0 auto; }
.stage img { width: 100%; user-select: none; }
.stage .over { position: absolute; inset: 0; height: 100%; }
.stage .handle { position: absolute; top: 0; bottom: 0; width: 2px; margin-left: -1px; background: #fff;
  box-shadow: 0 0 6px rgba(0, 0, 0, .55); pointer-events: none; }
.stage .handle::after { content: "\2194"; position: absolute; top: 50%; left: 50%; width: 34px; height: 34px;
  margin: -17px 0 0 -17px; border-radius: 50%; background: #fff; color: var(--ink); font-size: 17px; line-height: 33px;
  text-align: center; box-shadow: 0 1px 6px rgba(0, 0, 0, .4); }
.stage input { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; cursor: ew-resize; }
.tag { position: absolute; top: 10px; padding: 4px 10px; border-radius: 6px; background: rgba(20, 24, 31, .72);
  color: #fff; font-size: 12.5px; line-height: 1.4; pointer-events: none; }
.tag.left { left: 10px; } .tag.right { right: 10px; }
.two { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 360px), 1fr)); gap: 12px; }
.two .stage { width: 100%; max-width: none; }
.scale { display: flex; align-items: center; gap: 10px; font-size: 12.5px; color: var(--soft); margin: 10px 0 0; }
.scale i { width: 190px; height: 10px; border-radius: 3px; border: 1px solid var(--line); }
.below { margin-top: 16px; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 5px 20px; margin: 0; font-size: 13.5px; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
@media (max-width: 640px) {
  main { padding: 22px 12px 40px; } section { padding: 16px 14px; } h1 { font-size: 24px; } .verdict { font-size: 17px; }
  .facts span + span::before { display: none; }
}
)css";
}

} // namespace luxel
