// browser.mjs RUNS [PICTURES]   opens the pages in the folders of RUNS in a browser without network
// and does what a person would; exit code 1 where a test fails. Pictures are written into PICTURES.
// Each file has a browser of its own. Two files run at a time, since a page mostly waits, but for those
// that compare a page with the clock on the wall.
import { spawn } from 'node:child_process';
import { fileURLToPath } from 'node:url';

const alone = ['live_page', 'run_page'];
const others = ['study_page', 'compare_page', 'references', 'plots_page', 'fit_page', 'run_list_page', 'stand_page',
  'units_page', 'gallery_page'];  // the longest first

// Prints what the tests of a file print, in one piece, when they have ended.
const run = (name) => new Promise((done) => {
  const file = fileURLToPath(new URL(`${name}.mjs`, import.meta.url));
  const child = spawn(process.execPath, [file, ...process.argv.slice(2)], { stdio: ['ignore', 'pipe', 'inherit'] });
  let printed = '';
  child.stdout.setEncoding('utf8').on('data', (text) => { printed += text; });
  child.on('close', (code) => {
    process.stdout.write(printed);
    if (code !== 0) process.exitCode = 1;
    done();
  });
});
const run_in_turn = async (names) => {
  while (names.length) await run(names.shift());
};

await run_in_turn(alone);
await Promise.all([run_in_turn(others), run_in_turn(others)]);
