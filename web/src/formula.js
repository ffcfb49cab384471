// Formulas of channels, as "/joint/hip/angle - /desired/joint/hip/angle". They are parsed into a tree, and
// their unit is derived from it. The text is never run as code.
import { dims_of, name_of, none, same, times, unit_word } from './dimension.js';

const longest = 500;   // characters
const deepest = 40;    // nested parentheses

export const functions = {
  abs: { takes: 1, does: 'absolute value' },
  deriv: { takes: 1, does: 'time derivative' },
  integral: { takes: 1, does: 'time integral' },
  mean: { takes: 2, does: 'mean over a window about each time, as mean(x, 0.1 s)' },
  sqrt: { takes: 1, does: 'square root' },
  sin: { takes: 1, does: 'sine of an angle' },
  cos: { takes: 1, does: 'cosine of an angle' },
  min: { takes: 2, does: 'the smaller one' },
  max: { takes: 2, does: 'the larger one' },
};

export class FormulaError extends Error {
  constructor(at, found, expected) {
    super(`column ${at + 1}: found ${found}; expected ${expected}`);
    this.at = at;
  }
}

function distance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, i) => i);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let k = 1; k <= b.length; ++k)
      next.push(Math.min(row[k] + 1, next[k - 1] + 1, row[k - 1] + (a[i - 1] === b[k - 1] ? 0 : 1)));
    row = next;
  }
  return row[b.length];
}

export function nearest(word, names) {
  const far = names.map((name) => [distance(word, name), name]).sort((a, b) => a[0] - b[0]);
  return far.length && far[0][0] <= Math.max(2, word.length / 3) ? far[0][1] : null;
}

class Parser {
  constructor(text, channels) {
    this.text = text;
    this.channels = channels;
    // The longest first, since one name may be the beginning of another.
    this.ids = [...channels.keys()].sort((a, b) => b.length - a.length);
    this.at = 0;
    this.depth = 0;
  }

  skip() {
    while (/\s/.test(this.text[this.at] ?? '')) ++this.at;
  }

  peek() {
    this.skip();
    return this.text[this.at] ?? '';
  }

  found() {
    const rest = this.text.slice(this.at).match(/^(?:[\w/.]+|.)/)?.[0];
    return rest ? `"${rest}"` : 'the end';
  }

  fail(expected) {
    throw new FormulaError(this.at, this.found(), expected);
  }

  whole() {
    if (this.text.length > longest) throw new FormulaError(longest, 'more text', `at most ${longest} characters`);
    const tree = this.sum();
    if (this.peek()) this.fail('+ - * / or the end');
    return tree;
  }

  chain(operators, next) {
    let a = next();
    for (let op = this.peek(); op && operators.includes(op); op = this.peek()) {
      const at = this.at++;
      a = { kind: 'op', op, at, a, b: next() };
    }
    return a;
  }

  sum() {
    if (++this.depth > deepest) this.fail(`at most ${deepest} nested parentheses`);
    const tree = this.chain('+-', () => this.chain('*/', () => this.signed()));
    --this.depth;
    return tree;
  }

  signed() {
    let minus = false;
    while (['-', '+'].includes(this.peek())) minus = (this.text[this.at++] === '-') !== minus;
    return minus ? { kind: 'minus', a: this.operand() } : this.operand();
  }

  operand() {
    const c = this.peek();
    if (c === '(') {
      ++this.at;
      const inner = this.sum();
      this.close();
      return inner;
    }
    return this.channel() ?? this.number() ?? this.word();
  }

  close() {
    if (this.peek() !== ')') this.fail(')');
    ++this.at;
  }

  channel() {
    const rest = this.text.slice(this.at);
    for (const id of this.ids)
      for (const name of [id, id.slice(1)])
        if (rest.startsWith(name) && !/^(\w|\.\w)/.test(rest.slice(name.length))) {
          const at = this.at;
          this.at += name.length;
          return { kind: 'channel', id, at };
        }
    return null;
  }

  // Parses a number and the units after it, "5 N m". A "/" after them is a division.
  number() {
    const found = this.text.slice(this.at).match(/^(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i)?.[0];
    if (!found) return null;
    let out = { kind: 'number', value: Number(found), at: this.at, dims: none };
    this.at += found.length;
    for (;;) {
      this.skip();
      const word = this.text.slice(this.at).match(/^[A-Za-z]+|^%/)?.[0];
      const unit = word && unit_word(word);
      if (!unit) return out;
      this.at += word.length;
      out = { ...out, value: out.value * unit.scale, dims: times(out.dims, unit.dims) };
    }
  }

  word() {
    const word = this.text.slice(this.at).match(/^[A-Za-z_]\w*/)?.[0];
    if (!word) return this.unknown();
    const at = this.at;
    if (/^\s*\(/.test(this.text.slice(at + word.length))) return this.call(word);
    if (word === 'pi') return (this.at += 2), { kind: 'number', value: Math.PI, at, dims: none };
    const unit = unit_word(word);
    if (!unit) return this.unknown();
    this.at += word.length;
    return { kind: 'number', value: unit.scale, at, dims: unit.dims };
  }

  unknown() {
    const word = this.text.slice(this.at).match(/^[\w/.]+/)?.[0];
    const near = word && nearest(word, [...this.ids, ...Object.keys(functions)]);
    this.fail(`a channel, a number, a function or a parenthesis${near ? `; did you mean ${near}` : ''}`);
  }

  call(name) {
    const at = this.at, takes = Object.hasOwn(functions, name) ? functions[name].takes : 0;
    if (!takes) {
      const near = nearest(name, Object.keys(functions));
      this.fail(`one of ${Object.keys(functions).join(', ')}${near ? `; did you mean ${near}` : ''}`);
    }
    this.at = this.text.indexOf('(', at) + 1;
    const args = [this.sum()];
    while (args.length < takes) {
      if (this.peek() !== ',') this.fail(`a comma: ${name} takes ${takes} values, as in ${name === 'mean' ? 'mean(x, 0.1 s)' : `${name}(a, b)`}`);
      ++this.at;
      args.push(this.sum());
    }
    this.close();
    return { kind: 'call', name, at, args };
  }
}

// --- units ---
//
// The unit of a result has `dims`, null if the unit of a channel is unknown; `name` in the log's spelling,
// if it is the unit of a channel; `zeros`, the number of absolute pressures summed up in it: 0 for the
// difference of two.

const is_pressure = (dims) => dims && same(dims, dims_of('Pa'));
const spelled = (u) => (!u.dims ? 'an unknown unit' : same(u.dims, none) ? 'a plain number' : u.name ?? name_of(u.dims));

function unit_of_channel(unit) {
  const dims = dims_of(unit);
  return { dims, name: unit, zeros: is_pressure(dims) && /^Pa( abs)?$/.test(unit) ? 1 : 0 };
}

function unit_of_sum(node, a, b) {
  if (!a.dims || !b.dims) return { dims: a.dims && b.dims, zeros: 0 };
  if (!same(a.dims, b.dims)) {
    const bare = [node.a, node.b].some((n) => n?.kind === 'number' && same(n.dims, none));
    throw new FormulaError(node.at, `${spelled(a)} ${node.op ?? 'and'} ${spelled(b)}`,
      `the same unit on both sides${bare ? '; write the unit after the number, as in 2 deg' : ''}`);
  }
  const zeros = node.op === '-' ? a.zeros - b.zeros : node.op === '+' ? a.zeros + b.zeros : Math.max(a.zeros, b.zeros);
  return { dims: a.dims, zeros, name: a.name === b.name && !a.zeros && !b.zeros ? a.name : undefined };
}

function unit_of_product(node, a, b) {
  if (!a.dims || !b.dims) return { dims: null, zeros: 0 };
  const dims = times(a.dims, b.dims, node.op === '/' ? -1 : 1);
  // A mean of two pressures, (a + b)/2, counts as one.
  const by = node.b.kind === 'number' && same(b.dims, none) ? node.b.value : node.a.kind === 'number' && node.op === '*' && same(a.dims, none) ? node.a.value : null;
  if (by === null) return { dims, zeros: 0 };
  const of = node.b.kind === 'number' ? a : b;
  return { dims, zeros: node.op === '/' ? of.zeros / by : of.zeros * by };
}

function unit_of_call(node, channels) {
  const [a, b] = node.args.map((arg) => unit_of(arg, channels));
  const seconds = dims_of('s'), plain = (u) => !u.dims || same(u.dims, none);
  switch (node.name) {
    case 'mean':
      if (node.args[1].kind !== 'number' || !(node.args[1].value > 0) || !(plain(b) || same(b.dims, seconds)))
        throw new FormulaError(node.at, 'mean over another window', 'a time above zero, as in mean(x, 0.1 s)');
      return a;
    case 'abs':
      return a;
    case 'deriv':
      return { dims: a.dims && times(a.dims, seconds, -1), zeros: 0 };
    case 'integral':
      return { dims: a.dims && times(a.dims, seconds), zeros: 0 };
    case 'sqrt':
      return { dims: a.dims && a.dims.map((p) => p / 2), zeros: 0 };
    case 'sin':
    case 'cos':
      if (!plain(a) && !same(a.dims, dims_of('rad')))
        throw new FormulaError(node.at, `${node.name} of ${spelled(a)}`, 'an angle');
      return { dims: none, zeros: 0 };
    default:  // min, max
      return unit_of_sum({ at: node.at, a: node.args[0], b: node.args[1] }, a, b);
  }
}

function unit_of(node, channels) {
  switch (node.kind) {
    case 'number':
      return { dims: node.dims, zeros: 0 };
    case 'channel':
      return unit_of_channel(channels.get(node.id));
    case 'minus': {
      const a = unit_of(node.a, channels);
      return { ...a, zeros: -a.zeros, name: a.zeros ? undefined : a.name };
    }
    case 'call':
      return unit_of_call(node, channels);
    default: {
      const a = unit_of(node.a, channels), b = unit_of(node.b, channels);
      return '+-'.includes(node.op) ? unit_of_sum(node, a, b) : unit_of_product(node, a, b);
    }
  }
}

// Returns the unit in the spelling of the pages: "Pa" for an absolute pressure, "Pa diff" for a difference.
function word_of(unit) {
  if (!unit.dims) return '1';
  if (unit.name && !(is_pressure(unit.dims) && unit.zeros !== 1 && /^Pa( abs)?$/.test(unit.name))) return unit.name;
  if (!is_pressure(unit.dims)) return name_of(unit.dims);
  return Math.abs(unit.zeros - 1) < 1e-9 ? 'Pa' : 'Pa diff';
}

function* ids_in(node) {
  if (node.kind === 'channel') yield node.id;
  for (const part of [node.a, node.b, ...(node.args ?? [])]) if (part) yield* ids_in(part);
}

// Parses a formula. `channels` maps each channel's id to its SI unit. Returns the tree, the unit of its
// result, and the ids of its channels. Throws FormulaError if the text or its units are wrong.
export function parse_formula(text, channels) {
  const tree = new Parser(text, channels).whole();
  const ids = [...new Set(ids_in(tree))];
  if (!ids.length) throw new FormulaError(0, 'numbers alone', 'at least one channel');
  return { tree, ids, unit: word_of(unit_of(tree, channels)) };
}
