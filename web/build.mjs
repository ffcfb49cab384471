// build.mjs FILE.cpp        bundles src/ into pages and writes them as a C++ source file of the program
// build.mjs [FILE.html]     writes only the page of a run, into page.html if no name is given
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import esbuild from 'esbuild';

const src = join(dirname(fileURLToPath(import.meta.url)), 'src');
const out = process.argv[2] ?? 'page.html';

function bundle(entry) {
  const result = esbuild.buildSync({
    entryPoints: [join(src, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome110', 'firefox115', 'safari16.4'],
    charset: 'utf8',
    legalComments: 'inline',
  });
  return result.outputFiles[0].text.trim();
}

// Repeats the dark colors in a media query: style.css has them once, for the button; the page also
// uses them where the system is dark.
function dark_by_system(css) {
  const rule = css.match(/:root\[data-theme=["']?dark["']?\]\{([^}]*)\}/);
  if (!rule) throw new Error('style.css: no dark colors');
  return css.replace(rule[0], `${rule[0]}@media (prefers-color-scheme:dark){:root:not([data-theme]){${rule[1]}}}`);
}

const text_of = (name) => readFileSync(join(src, name), 'utf8');

// `connect`: mark in the content security policy of pages that can be served; the program
// replaces it by the address that the page may connect to.
function page_of(main, style, script, connect = '') {
  let page = text_of('frame.html').replace('/*connect*/', connect);
  page = page.replace('<!-- main -->\n', () => text_of(main));
  page = page.replace('      <!-- player -->\n', () => text_of('player.html'));
  page = page.replace('/*style*/', () => dark_by_system(bundle(style)));
  page = page.replace('/*script*/', () => bundle(script));

  // Each mark that the program replaces must occur once.
  for (const mark of ['@title@', '@units@', '@run@', '@samples@'])
    if (page.split(mark).length !== 2) throw new Error(`${mark} must occur exactly once in frame.html and ${main}`);
  return page;
}

function as_cpp(name, text) {
  if (text.includes(')page"')) throw new Error('the page contains )page", which ends the raw string literal');
  return `
std::string_view sinew::report::${name}() {
  static constexpr char text[] = R"page(${text})page";
  return {text, sizeof text - 1};
}
`;
}

const run = page_of('page.html', 'style.css', 'main.js', '@connect@');
if (out.endsWith('.cpp'))
  writeFileSync(out, '// Made by web/build.mjs.\n#include "sinew/report/page/page.h"\n' +
    as_cpp('page_template', run) +
    as_cpp('comparison_template', page_of('compare.html', 'compare.css', 'compare.js')) +
    as_cpp('fit_template', page_of('fit.html', 'style.css', 'fit.js')) +
    as_cpp('design_template', page_of('design.html', 'style.css', 'design.js')) +
    as_cpp('study_template', page_of('study.html', 'study.css', 'study.js', '@connect@')) +
    as_cpp('run_list_template', page_of('run_list.html', 'run_list.css', 'run_list.js', '@connect@')));
else
  writeFileSync(out, run);
