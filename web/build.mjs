// build.mjs [FILE]   bundles src/ into one page. FILE.cpp: as the source file that the program is
// built with; FILE.html, or page.html without one: as it is.
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

let page = readFileSync(join(src, 'page.html'), 'utf8');
page = page.replace('/*style*/', () => bundle('style.css'));
page = page.replace('/*script*/', () => bundle('main.js'));

// What the program fills in must have one place each.
for (const mark of ['@title@', '@run@', '@samples@'])
  if (page.split(mark).length !== 2) throw new Error(`${mark}: not once in the page`);

function as_cpp(text) {
  if (text.includes(')page"')) throw new Error('the page ends its own literal');
  return `// Made by web/build.mjs.
#include "sinew/report/page_template.h"

std::string_view sinew::report::page_template() {
  static constexpr char text[] = R"page(${text})page";
  return {text, sizeof text - 1};
}
`;
}

writeFileSync(out, out.endsWith('.cpp') ? as_cpp(page) : page);
