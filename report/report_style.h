#pragma once

namespace morula::scenarios {

/// Style sheet of report.html. No `<`, `&` and no web fonts: the page stays well-formed and fetches nothing.
inline constexpr const char* kReportStyle = R"(
:root { color-scheme: light dark; --ink: #22252b; --soft: #5d6470; --line: #dde1e7; --page: #ffffff; --card: #f5f7f9;
  --good: #1a7f4b; --bad: #b3261e; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7ec; --soft: #9aa3b0; --line: #363c46; --page: #16191e; --card: #1f242b;
  --good: #5ecb94; --bad: #ff8a80; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); font: 16px/1.5 system-ui, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 32px 24px 64px; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 4px; }
h2 { font-size: 1.25rem; margin: 44px 0 12px; padding-bottom: 6px; border-bottom: 1px solid var(--line); }
h3 { font-size: 1.02rem; margin: 24px 0 6px; }
small, .sub, figcaption, .source { color: var(--soft); font-weight: 400; }
code, .equation { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, monospace; font-size: 0.93em; }
.equation { background: var(--card); padding: 8px 12px; border-radius: 6px; overflow-x: auto; white-space: pre-wrap; }
table { border-collapse: collapse; width: 100%; font-size: 0.93rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: 6px 12px 6px 0; border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
th { color: var(--soft); font-weight: 600; }
tr.good td:last-child, .good { color: var(--good); }
tr.bad td:last-child, .bad { color: var(--bad); }
tr.good, tr.bad { color: inherit; }
.badge { display: inline-block; margin: 0 0 10px; padding: 2px 12px; border: 1px solid currentColor; border-radius: 999px; font-weight: 600; }
.warning { border-left: 4px solid var(--bad); padding: 8px 14px; background: var(--card); }
.numbers { display: grid; grid-template-columns: repeat(auto-fill, minmax(170px, 1fr)); gap: 12px; margin: 0; }
.numbers div { background: var(--card); border-radius: 8px; padding: 12px 14px; }
.numbers dt { color: var(--soft); font-size: 0.85rem; }
.numbers dd { margin: 2px 0 0; font-size: 1.35rem; font-weight: 600; }
figure { margin: 0; }
figcaption { font-size: 0.86rem; margin-top: 4px; }
img { width: 100%; height: auto; display: block; border: 1px solid var(--line); border-radius: 8px; background: #fff; }
svg { width: 100%; height: auto; display: block; }
.film label { display: flex; gap: 10px; align-items: center; color: var(--soft); font-size: 0.86rem; }
.film input { flex: 1; }
details { margin: 14px 0; }
summary { cursor: pointer; font-weight: 600; margin-bottom: 8px; }
pre { background: var(--card); padding: 12px; border-radius: 6px; overflow-x: auto; font-size: 0.85rem; }
.large, .plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 430px), 1fr)); gap: 22px; }
@media print { main { max-width: none; padding: 0; } figure, tr, article { break-inside: avoid; }
  figure[hidden] { display: block; } .film label { display: none; } .large, .plots { grid-template-columns: 1fr 1fr; } }
)";

}  // namespace morula::scenarios
