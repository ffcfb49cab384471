// Channels of a run by id. Plots show them and formulas refer to them.

export const id_of_line = (line) => (line.field ? `${line.topic}.${line.field}` : line.topic);

export class ChannelList {
  // `run.panels` lists all channels.
  constructor(run, columns) {
    this.columns = columns;
    this.list = [];
    this.by_id = new Map();
    for (const panel of run.panels)
      for (const line of panel.lines) {
        line.id = id_of_line(line);
        if (this.by_id.has(line.id)) continue;
        const channel = { id: line.id, label: line.label, title: panel.title, unit: panel.unit, column: line.column };
        this.by_id.set(line.id, channel);
        this.list.push(channel);
      }
    this.units = new Map(this.list.map((c) => [c.id, c.unit]));
  }

  column(id) {
    return this.columns[this.by_id.get(id).column];
  }

  // Returns the channels that have at least one finite value so far.
  with_samples() {
    return this.list.filter((c) => (c.has ||= this.columns[c.column].values.some((v) => v === v)));
  }

  words(channel) {
    return `${channel.title} · ${channel.label}`;
  }
}
