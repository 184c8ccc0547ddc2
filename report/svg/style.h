// The page's style sheet makes one column of cards, light or dark as the reader's system is.
#pragma once

namespace voxmelt::page {

inline constexpr const char* kStyle = R"(
:root { color-scheme: light dark;
  --paper: #fbfaf7; --card: #ffffff; --ink: #1f2328; --soft: #646a73; --line: #e4e1da; --faint: #f3f1ec;
  --good: #2a7f62; --bad: #c23b2a; --band: #2a7f621c;
  --c0: #c8571b; --c1: #2b5fa8; --c2: #7a4fa3; --c3: #2a7f62; --c4: #b02a63; --c5: #7d6a12; --c6: #0e7c8a; }
@media (prefers-color-scheme: dark) { :root {
  --paper: #15171b; --card: #1c1f25; --ink: #e6e4df; --soft: #9aa0aa; --line: #31353d; --faint: #23272e;
  --good: #5cc29c; --bad: #ff7a66; --band: #5cc29c22;
  --c0: #ff9a5a; --c1: #7fb0f5; --c2: #c39bea; --c3: #5cc29c; --c4: #f582ae; --c5: #d8c25c; --c6: #56cbd8; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.55 system-ui, -apple-system, "Segoe UI",
  "Helvetica Neue", "Noto Sans", sans-serif; font-variant-numeric: tabular-nums; }
main { max-width: 1120px; margin: 0 auto; padding: 48px 24px 96px; }
h1 { font-size: 34px; line-height: 1.15; margin: 0 0 10px; letter-spacing: -.02em; }
h2 { font-size: 15px; letter-spacing: .09em; text-transform: uppercase; color: var(--soft); margin: 56px 0 14px; }
h3 { font-size: 19px; margin: 0 0 4px; letter-spacing: -.01em; }
p { margin: 0 0 14px; max-width: 74ch; }
.soft { color: var(--soft); }
.lead { font-size: 18px; }
.tally { display: flex; flex-wrap: wrap; gap: 12px; margin: 24px 0 8px; }
.tally div { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 12px 20px; min-width: 132px; }
.tally b { display: block; font-size: 28px; line-height: 1.2; letter-spacing: -.02em; }
.tally span { color: var(--soft); font-size: 14px; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 14px; padding: 24px 26px 18px; margin: 0 0 20px;
  scroll-margin-top: 16px; }
.card > p { color: var(--soft); }
.head { display: flex; justify-content: space-between; gap: 20px; align-items: baseline; }
.pill { font-size: 13px; font-weight: 600; white-space: nowrap; padding: 2px 11px; border-radius: 99px; border: 1px solid; }
.good { color: var(--good); fill: var(--good); } .bad { color: var(--bad); fill: var(--bad); }
.told { fill: none; stroke: var(--soft); stroke-width: 1.6; }
.rows { overflow-x: auto; }
table { border-collapse: collapse; table-layout: fixed; width: 100%; min-width: 860px; font-size: 14px; }
th { width: 84px; } th:first-child { width: auto; } th:last-child { width: 46px; }
th { text-align: left; font-weight: 500; color: var(--soft); border-bottom: 1px solid var(--line); padding: 6px 10px 6px 0; }
td { border-bottom: 1px solid var(--faint); padding: 5px 10px 5px 0; vertical-align: baseline; }
tr:last-child td { border-bottom: 0; }
.n { text-align: right; white-space: nowrap; }
td.e { font-weight: 600; }
td small { color: var(--soft); font-size: 12.5px; display: block; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(430px, 100%), 1fr)); gap: 14px 26px; margin-top: 18px; }
figure { margin: 0; max-width: 560px; }
figcaption { font-size: 14px; font-weight: 600; margin-bottom: 2px; }
.legend { font-size: 12.5px; color: var(--soft); display: flex; flex-wrap: wrap; gap: 1px 14px; min-height: 20px; }
.legend i { display: inline-block; width: 9px; height: 9px; border-radius: 50%; margin-right: 5px; }
.legend i.line { width: 16px; height: 0; border-radius: 0; border-top: 2px solid var(--ink); vertical-align: 4px; opacity: .6; }
svg { width: 100%; height: auto; display: block; overflow: visible; }
svg text { fill: var(--soft); font-size: 12px; } svg .label { font-size: 12.5px; }
svg .name { fill: var(--ink); font-size: 13px; }
.grid { stroke: var(--line); stroke-width: 1; } .zero, .mark { stroke: var(--soft); stroke-width: 1; }
.gate { stroke: var(--ink); stroke-width: 1.5; stroke-dasharray: 4 4; }
.band { fill: var(--band); }
.exact { fill: none; stroke: var(--ink); stroke-width: 1.8; opacity: .6; }
.joined { fill: none; stroke-width: 1.4; opacity: .75; }
.k0 { stroke: var(--c0); } .k1 { stroke: var(--c1); } .k2 { stroke: var(--c2); } .k3 { stroke: var(--c3); } .k4 { stroke: var(--c4); } .k5 { stroke: var(--c5); } .k6 { stroke: var(--c6); }
.f0 { fill: var(--c0); } .f1 { fill: var(--c1); } .f2 { fill: var(--c2); } .f3 { fill: var(--c3); } .f4 { fill: var(--c4); } .f5 { fill: var(--c5); } .f6 { fill: var(--c6); }
.b0 { background: var(--c0); } .b1 { background: var(--c1); } .b2 { background: var(--c2); } .b3 { background: var(--c3); } .b4 { background: var(--c4); } .b5 { background: var(--c5); } .b6 { background: var(--c6); }
)";

}  // namespace voxmelt::page
