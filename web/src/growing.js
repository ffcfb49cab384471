// Columns that grow while a run continues: its pieces are appended to the columns of the page
// (sinew/report/page/live_page.h). Columns of one clock share their times, as on the page of a finished run.

// Typed array with spare capacity.
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
  // `layout.columns` has the clock of each column.
  constructor(layout) {
    this.clock_of = layout.columns;
    this.clocks = layout.clocks.map(() => new Row(Float64Array));
    this.values = layout.columns.map(() => new Row(Float32Array));
    this.columns = layout.columns.map(() => ({ time: new Float64Array(), values: new Float32Array() }));
  }

  // `piece` has one column for each column of the page.
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

// Appends phases; a phase that continues from one piece to the next is extended.
export function append_stretches(all, more) {
  for (const s of more) {
    const last = all.at(-1);
    if (last && last.phase === s.phase && last.step === s.step && s.from <= last.to + 1e-6) last.to = s.to;
    else all.push({ ...s });
  }
}
