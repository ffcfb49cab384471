// Columns that grow: pieces of a run are appended to those of the page (sinew/report/page/growing.h).
// Those of one clock share their times, as in a page that is whole.

// A typed array with room behind its end.
class Row {
  constructor(Kind) {
    this.room = new Kind(4096);
    this.length = 0;
  }

  append(more) {
    if (this.length + more.length > this.room.length) {
      const larger = new this.room.constructor(Math.max(2 * this.room.length, this.length + more.length));
      larger.set(this.room.subarray(0, this.length));
      this.room = larger;
    }
    this.room.set(more, this.length);
    this.length += more.length;
    return this.room.subarray(0, this.length);
  }
}

export class GrowingColumns {
  // `layout` says which clock each column has.
  constructor(layout) {
    this.clock_of = layout.columns;
    this.clocks = layout.clocks.map(() => new Row(Float64Array));
    this.values = layout.columns.map(() => new Row(Float32Array));
    this.columns = layout.columns.map(() => ({ time: new Float64Array(), values: new Float32Array() }));
  }

  // `piece`: a column for each of ours.
  append(piece) {
    const times = this.clocks.map(() => null);
    piece.forEach((more, i) => {
      const clock = this.clock_of[i], column = this.columns[i];
      times[clock] ??= this.clocks[clock].append(more.time);
      column.time = times[clock];
      column.values = this.values[i].append(more.values);
    });
  }
}

// Phases that go on from one piece to the next are one.
export function append_stretches(all, more) {
  for (const s of more) {
    const last = all.at(-1);
    if (last && last.phase === s.phase && last.step === s.step && s.from <= last.to + 1e-6) last.to = s.to;
    else all.push({ ...s });
  }
}
