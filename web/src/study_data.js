// Rows of one or two studies as columns of numbers, matched by heading and filtered by ranges and words.
// Independent of the page.

// Splits a heading such as "joint.hip.angle_gain [%/count]" into key and unit.
export function heading_parts(heading) {
  const found = /^(.*?) \[(.*)\]$/.exec(heading);
  return found ? { key: found[1], unit: found[2] } : { key: heading, unit: '' };
}

// Returns whether a smaller value is usually better. The reader can change the direction on the page.
export const usually_less = (heading) =>
  /rms|error|overshoot|oscillation|air|energy|switchings|duty|time|settling|violation/.test(heading);

// Returns a text quoted for a shell, if necessary.
const quoted = (text) => (/^[\w.,:+/=@%-]+$/.test(text) ? text : `"${text.replace(/(["\\$`])/g, '\\$1')}"`);

class Column {
  constructor({ heading, number, role, maximize, set = role === 'parameter' }) {
    Object.assign(this, { heading, number, role, set, ...heading_parts(heading) });
    this.less = role === 'objective' ? !maximize : usually_less(heading);
    this.texts = [];     // as in the table
    this.values = [];    // NaN if missing; for text, the index in `words`
    this.words = [];
    this.low = Infinity;  // of the values
    this.high = -Infinity;
  }

  put(row, text) {
    this.texts[row] = text;
    const value = text === '' ? NaN : this.number ? Number(text) : this.word(text);
    this.values[row] = Number.isFinite(value) ? value : NaN;
    if (value < this.low) this.low = value;
    if (value > this.high) this.high = value;
  }

  word(text) {
    const at = this.words.indexOf(text);
    if (at >= 0) return at;
    if (this.words.length >= 50) return NaN;  // an axis has no room for more, as with messages
    return this.words.push(text) - 1;
  }

  get varies() { return this.high > this.low; }
}

export class StudyData {
  constructor(studies) {
    this.studies = studies.map((s, study) => ({ ...s, study, letter: 'AB'[study], path: study ? 'b/' : '', at: new Map(), count: 0 }));
    this.columns = [];
    this.by_heading = new Map();
    Object.assign(this, { study: [], number: [], ok: [], generation: [], violation: [], feasible: [], count: 0 });
    for (const s of this.studies) s.own = s.columns.map((c) => this.column(c));
    for (const s of this.studies) this.add(s, s.rows);
  }

  // Returns the column of a heading, which both studies share. It is a parameter if it is one in either study.
  column(spec) {
    let found = this.by_heading.get(spec.heading);
    if (!found) {
      found = new Column(spec);
      this.by_heading.set(spec.heading, found);
      this.columns.push(found);
    }
    found.number &&= spec.number;
    if (spec.role === 'parameter') Object.assign(found, { role: 'parameter', set: true });
    return found;
  }

  // Adds rows [number, ok, generation, violation, cells]; a row with a known number replaces the old one.
  // Returns the number of new rows.
  add(study, rows) {
    const before = this.count;
    for (const [number, ok, generation, violation, cells] of rows) {
      const row = study.at.get(number) ?? this.count++;
      study.at.set(number, row);
      this.study[row] = study.study;
      this.number[row] = number;
      this.ok[row] = Boolean(ok);
      this.generation[row] = generation;
      this.violation[row] = violation;
      this.feasible[row] = Boolean(ok) && !(violation > 0);
      for (const c of this.columns) if (!study.own.includes(c)) c.values[row] = NaN;
      study.own.forEach((c, i) => c.put(row, cells[i] ?? ''));
    }
    study.count = study.at.size;
    return this.count - before;
  }

  // Returns whether all studies have the column.
  is_common(column) {
    return this.studies.every((s) => s.own.includes(column));
  }

  name_of(row) {
    const { letter } = this.studies[this.study[row]];
    return this.studies.length > 1 ? `${letter}${this.number[row]}` : String(this.number[row]);
  }

  // Returns the shell command that repeats a row; for a candidate, in one of its cases.
  command_of(row, one = this.studies[this.study[row]]) {
    const study = this.studies[this.study[row]];
    let { experiment } = one;
    const sets = [...(one.sets ?? [])];
    for (const c of study.own) {
      if (!c.set || !c.texts[row]) continue;
      if (c.key === 'experiment') experiment = in_folder_of(experiment, c.texts[row]);
      else sets.push(`${c.key}=${c.texts[row]}${c.unit && c.number ? ` ${c.unit}` : ''}`);
    }
    return [`sinew run ${quoted(experiment)}`, ...sets.map((s) => `--set ${quoted(s)}`),
            ...(study.allow_unreachable ? ['--allow-unreachable'] : [])].join(' ');
  }
}

// Returns a name relative to the folder of `file`.
function in_folder_of(file, name) {
  return name.startsWith('/') || !file.includes('/') ? name : file.replace(/[^/]*$/, name);
}

// Filter of rows: shown are those within every range, with every word, of the studies that are switched on.
export class Filter {
  constructor(data) {
    this.data = data;
    this.ranges = new Map();  // [from, to] by column
    this.words = [];
    this.only_feasible = false;
    this.studies = data.studies.map(() => true);
    this.update();
  }

  set_range(column, range) {
    if (range) this.ranges.set(column, range);
    else this.ranges.delete(column);
    this.update();
  }

  get is_on() { return this.ranges.size > 0 || this.words.length > 0 || this.only_feasible || this.studies.includes(false); }

  clear() {
    this.ranges.clear();
    this.words = [];
    this.only_feasible = false;
    this.studies.fill(true);
    this.update();
  }

  lets(row) {
    const { data } = this;
    if (!this.studies[data.study[row]] || (this.only_feasible && !data.feasible[row])) return false;
    for (const [column, [from, to]] of this.ranges) {
      const v = column.values[row];
      if (!(v >= from && v <= to)) return false;
    }
    return !this.words.length || this.has_words(row);
  }

  has_words(row) {
    const { data } = this;
    const text = `${data.name_of(row)} ${data.columns.map((c) => c.texts[row] ?? '').join(' ')}`.toLowerCase();
    return this.words.every((w) => text.includes(w));
  }

  update() {
    const { count } = this.data;
    this.shown = new Uint8Array(count);
    this.rows = [];
    this.hidden = [];
    for (let row = 0; row < count; ++row) {
      this.shown[row] = this.lets(row) ? 1 : 0;
      (this.shown[row] ? this.rows : this.hidden).push(row);
    }
  }
}
