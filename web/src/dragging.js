// Drag and drop of channels: from the list, a plot's heading or a line's name onto a plot.

const kind = 'application/x-sinew-channels';

export const dragged = {
  lines: null,

  // Makes an element draggable. `lines_of` returns the lines to drag, as a layout stores them.
  from(root, lines_of) {
    root.addEventListener('dragstart', (event) => {
      event.stopPropagation();
      this.lines = lines_of();
      event.dataTransfer.setData(kind, JSON.stringify(this.lines));
      event.dataTransfer.effectAllowed = 'copy';
      // Changes the page only after the browser has taken its drag image.
      setTimeout(() => document.documentElement.classList.toggle('dragging', Boolean(this.lines)));
    });
    root.addEventListener('dragend', () => this.end());
  },

  end() {
    this.lines = null;
    document.documentElement.classList.remove('dragging');
    document.querySelectorAll('.drop-here').forEach((r) => r.classList.remove('drop-here'));
  },

  // Makes an element a drop target. Calls `does` with the dropped lines.
  onto(root, does) {
    const ours = (event) => this.lines && event.dataTransfer.types.includes(kind);
    root.addEventListener('dragover', (event) => {
      if (!ours(event)) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = 'copy';
      root.classList.add('drop-here');
    });
    root.addEventListener('dragleave', (event) => !root.contains(event.relatedTarget) && root.classList.remove('drop-here'));
    root.addEventListener('drop', (event) => {
      if (!ours(event)) return;
      event.preventDefault();
      const { lines } = this;
      this.end();
      does(lines);
    });
  },
};
