#!/usr/bin/env node
// statements.mjs figures INDEX.json            prints the statements of a page of figures, one per line
// statements.mjs run NAME < VERDICTS.json      prints those of an experiment, from `sinew analyze --verdicts`
// statements.mjs count LIST                    prints their number by class and verdict, as a table
//
// A line has location, statement, class and verdict, separated by bars. ./check compares the lines with
// tests/claims/statements.txt: a change must be reviewed and then made there too.
import { readFileSync } from 'node:fs';

const line = (...cells) => cells.map((c) => String(c ?? '').replaceAll('|', '/').replaceAll('\n', ' ')).join(' | ');
const class_of = (statement) => statement.class ?? '-';

function of_figures(path) {
  const { figures } = JSON.parse(readFileSync(path, 'utf8'));
  return figures.flatMap((f) => (f.claims ?? []).map((c) =>
    line(`figure ${f.figure}`, `${c.says ?? c.quantity} (${c.where}${c.theirs ? `: ${c.theirs}` : ''})`, class_of(c), c.verdict)));
}

const of_run = (name, verdicts) => verdicts.map((v) =>
  line(name, `${v.key}: ${v.reported}`, class_of(v), v.is));

function count(path) {
  const numbers = new Map();
  const verdicts = ['agrees', 'differs', 'differs as known', 'agrees after all', 'not applicable'];
  const add = (where, of, verdict) => {
    const key = `${where}|${of}`;
    if (!numbers.has(key)) numbers.set(key, Object.fromEntries(verdicts.map((v) => [v, 0])));
    numbers.get(key)[verdict] += 1;
  };
  for (const text of readFileSync(path, 'utf8').split('\n')) {
    const [where, , of, verdict] = text.split(' | ');
    if (!verdict) continue;
    const part = where.startsWith('figure ') ? 'figures' : 'experiments';
    add(part, of, verdict);
    add(part, 'all', verdict);
  }
  const classes = ['predicted', 'fitted', 'put in', 'by construction', 'code against code', '-', 'all'];
  const row = (...cells) => `| ${cells.join(' | ')} |`;
  const out = [row('', 'class', ...verdicts, 'all'), row('---', '---', ...verdicts.map(() => '---:'), '---:')];
  for (const part of ['figures', 'experiments'])
    for (const of of classes) {
      const n = numbers.get(`${part}|${of}`);
      if (n) out.push(row(part, of === '-' ? 'not compared' : of, ...verdicts.map((v) => n[v] || ''),
        verdicts.reduce((sum, v) => sum + n[v], 0)));
    }
  return out;
}

const [mode, what] = process.argv.slice(2);
const modes = {
  figures: () => of_figures(what).sort(),
  run: () => of_run(what, JSON.parse(readFileSync(0, 'utf8'))).sort(),
  count: () => count(what),
};
if (!modes[mode] || !what) {
  console.error('statements.mjs figures INDEX.json | run NAME < VERDICTS.json | count LIST');
  process.exit(2);
}
for (const text of modes[mode]()) console.log(text);
