// report/figures/gallery_style.h - how the page of figures looks; colors as in web/src/style.css.
#pragma once

#include <string_view>

namespace sinew::report {

inline constexpr std::string_view gallery_style = R"css(
:root { color-scheme: light; --paper: #fff; --back: #f5f6f8; --ink: #1c2430; --quiet: #5d6878;
  --edge: #dfe3e9; --accent: #0b63b5; --good: #0a7a58; --bad: #b3401a; --known: #7a5c00; }
@media (prefers-color-scheme: dark) { :root { color-scheme: dark; --paper: #161b22; --back: #0e1217;
  --ink: #e4e9f0; --quiet: #93a0b1; --edge: #2b333e; --accent: #5fb0f2; --good: #46c79c;
  --bad: #f08a5d; --known: #d6bd62; } }
* { box-sizing: border-box; }
html { scroll-padding-top: 84px; }
body { margin: 0; background: var(--back); color: var(--ink); font: 15px/1.5 system-ui, -apple-system,
  'Segoe UI', Roboto, 'Helvetica Neue', 'DejaVu Sans', Arial, sans-serif;
  font-variant-numeric: tabular-nums; }
a { color: var(--accent); text-decoration: none; }
a:hover { text-decoration: underline; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
header, main { max-width: 1240px; margin: 0 auto; padding: 0 28px; }
header { padding-top: 34px; }
h1 { margin: 0 0 6px; font-size: 28px; line-height: 1.2; font-weight: 650; letter-spacing: -.01em; }
h2 { margin: 0; font-size: 18px; line-height: 1.3; font-weight: 650; }
h2 .number { margin-right: .6em; color: var(--quiet); font-weight: 500; }
h3 { margin: 20px 0 4px; font-size: 12px; font-weight: 600; color: var(--quiet); }
p { margin: 0; }
.lead { max-width: 74ch; color: var(--quiet); }
.tally { margin: 20px 0 12px; border-collapse: collapse; font-size: 14px; }
.tally caption { padding-bottom: 6px; text-align: left; color: var(--quiet); font-size: 13px; }
.tally th, .tally td { padding: 3px 0 3px 26px; text-align: right; }
.tally tbody th { padding-left: 0; text-align: left; font-weight: 500; }
.tally thead th { font-size: 13px; font-weight: 600; }
.tally tbody tr { border-top: 1px solid var(--edge); }
.tally tbody tr:last-child, .tally td:last-child { font-weight: 650; }
.bar { position: sticky; top: 0; z-index: 1; background: var(--back); border-bottom: 1px solid var(--edge); }
.bar > div { display: flex; flex-wrap: wrap; gap: 6px 14px; align-items: center; max-width: 1240px;
  margin: 0 auto; padding: 9px 28px; font-size: 13px; }
.bar nav { display: flex; flex-wrap: wrap; gap: 2px 11px; }
.bar label { color: var(--quiet); }
select { font: inherit; color: inherit; padding: 3px 8px; border: 1px solid var(--edge);
  border-radius: 7px; background: var(--paper); }
article { display: grid; grid-template-columns: minmax(0, 5fr) minmax(0, 7fr); gap: 4px 34px;
  margin: 22px 0; padding: 22px 24px 24px; border: 1px solid var(--edge); border-radius: 12px;
  background: var(--paper); }
article[hidden] { display: none; }
.head { grid-column: 1 / -1; display: flex; flex-wrap: wrap; gap: 4px 18px; align-items: baseline;
  justify-content: space-between; margin-bottom: 12px; }
.files { display: flex; flex-wrap: wrap; gap: 2px 12px; font-size: 13px; }
figure { margin: 0; position: sticky; top: 78px; align-self: start; }
figure img { display: block; width: 100%; height: auto; padding: 10px; border-radius: 8px; background: #fff; }
figcaption { margin-top: 10px; color: var(--quiet); font-size: 14px; }
dl { margin: 0; }
.claim { padding: 11px 0; border-top: 1px solid var(--edge); }
.claim:first-of-type { padding-top: 0; border-top: 0; }
.says { display: flex; gap: 14px; justify-content: space-between; align-items: baseline; }
.where { color: var(--quiet); font-size: 13px; }
.judged { flex: none; font-size: 13px; white-space: nowrap; }
.verdict { margin-left: 10px; font-weight: 650; }
.class { color: var(--quiet); }
.agrees { color: var(--good); } .differs { color: var(--bad); }
.known { color: var(--known); } .open { color: var(--quiet); font-weight: 500; }
.numbers { display: flex; flex-wrap: wrap; gap: 0 22px; margin-top: 3px; font-size: 14px; }
.numbers span { color: var(--quiet); } .numbers b { color: var(--ink); font-weight: 600; }
.why { color: var(--quiet); font-size: 13px; }
.curves { margin: 0; padding: 0; list-style: none; font-size: 13px; }
.curves li { padding: 2px 0; overflow-wrap: anywhere; }
.curves b { font-weight: 600; }
.curves .quiet { color: var(--quiet); }
.sheet { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 400px), 1fr)); gap: 18px; padding-top: 18px; }
.sheet article { display: block; margin: 0; }
.sheet figure { position: static; }
@media screen and (max-width: 860px) { article { grid-template-columns: minmax(0, 1fr); padding: 16px; }
  header, main { padding: 0 14px; } header { padding-top: 22px; } .bar > div { padding: 8px 14px; }
  .bar, figure { position: static; } html { scroll-padding-top: 8px; } figure { margin-bottom: 14px; }
  .says { flex-wrap: wrap; gap: 2px 12px; } .tally { display: block; overflow-x: auto; font-size: 12px; }
  .tally th, .tally td { padding-left: 10px; } }
@media print { :root { color-scheme: light; --paper: #fff; --back: #fff; --ink: #000; --quiet: #444;
  --edge: #bbb; --accent: #000; --good: #0a7a58; --bad: #b3401a; --known: #7a5c00; }
  body, .numbers, .verdict { font-size: 9pt; } figcaption, .where, .why, .curves { font-size: 8pt; }
  header, main { padding: 0; } figure { position: static; } .bar, .files { display: none; }
  article { break-inside: avoid; border-width: 1px 0 0; border-radius: 0; padding: 10pt 0; margin: 0; gap: 2pt 18pt; }
  .claim { padding: 5pt 0; } figure img { padding: 0; } }
)css";

// Shows the figures that were chosen.
inline constexpr std::string_view gallery_script = R"js(
const choice = document.getElementById('choice');
if (choice) {
  choice.parentElement.hidden = false;
  choice.addEventListener('change', () => {
    for (const a of document.querySelectorAll('article'))
      a.hidden = choice.value !== '' && !a.dataset.is.split(',').includes(choice.value);
  });
}
document.documentElement.dataset.ready = '';
)js";

}  // namespace sinew::report
