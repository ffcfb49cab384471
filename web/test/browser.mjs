// browser.mjs RUNS [PICTURES]   opens the pages in the folders of RUNS in a browser without network and
// operates them as a user would; exit code 1 if a test fails. Screenshots are written into PICTURES.
// Each *_page.mjs starts its own browser. Two files run at a time, since a page mostly waits, except those
// whose page must keep up with real time. Failures are printed last, because ./check shows the end of
// the output of a step.
import { spawn } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const folder = fileURLToPath(new URL('.', import.meta.url));
const alone = ['live_page.mjs', 'run_page.mjs'];
const long = ['study_page.mjs', 'compare_page.mjs', 'references_page.mjs', 'plots_page.mjs'];
const short = readdirSync(folder).filter((name) => name.endsWith('_page.mjs') && ![...alone, ...long].includes(name));
const failed = [];

// Runs the tests of a file; prints the output of tests that passed and stores that of tests that failed.
// If the file itself fails, its whole output is stored.
const run = (name) => new Promise((done) => {
  const child = spawn(process.execPath, [folder + name, ...process.argv.slice(2)], { stdio: ['ignore', 'pipe', 'pipe'] });
  let printed = '', errors = '';
  child.stdout.setEncoding('utf8').on('data', (text) => { printed += text; });
  child.stderr.setEncoding('utf8').on('data', (text) => { errors += text; process.stderr.write(text); });
  child.on('close', (code) => {
    const tests = printed.split(/^(?=# Subtest: )/m), wrong = code === 0 ? [] : tests.filter((test) => /^not ok /m.test(test));
    if (code === 0 || wrong.length) process.stdout.write(tests.filter((test) => !wrong.includes(test)).join(''));
    if (code !== 0) failed.push(`# ${name}, exit code ${code}\n`, ...(wrong.length ? wrong : tests), errors);
    done();
  });
});
const run_in_turn = async (names) => {
  while (names.length) await run(names.shift());
};

await run_in_turn(alone);
const others = [...long, ...short];
await Promise.all([run_in_turn(others), run_in_turn(others)]);
process.stdout.write(failed.join(''));
if (failed.length) process.exitCode = 1;
