// Film of a run, or of several runs over each other. python/sinew/_film.py requests one frame after the other from
// the page, each as base64. The content of a frame depends only on its time.
import { GIFEncoder, applyPalette, quantize } from 'gifenc';

function base64(bytes) {
  let text = '';
  for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
  return btoa(text);
}

class Film {
  // `size` in pixels; `still`: the camera does not follow the machine; `speed` is written into the picture
  // if it is not 1; `bare`: nothing is written into it.
  constructor({ size, dark, still, speed, bare = false }) {
    const { page } = window.sinew;
    this.page = page;
    this.machines = page.machines;  // of several runs
    this.scene = page.scene ?? page.machines.first;
    this.speed = speed;
    this.bare = bare;
    [this.width, this.height] = size;
    page.appearance.set_theme(dark ? 'dark' : 'light');
    this.scene.follow = !still;
    // The style of the page fits the drawing to the window; a film has its own size.
    this.scene.canvas.setAttribute('style', 'position: fixed; left: 0; top: 0; max-width: none; max-height: none; ' +
      `min-height: 0; width: ${this.width}px; height: ${this.height}px`);
    this.sheet = new OffscreenCanvas(this.width, this.height);
    this.ctx = this.sheet.getContext('2d', { willReadFrequently: true });
    this.gif = GIFEncoder();
    this.taken = 0;  // bytes of the GIF that were already returned
  }

  draw(t) {
    const { ctx, scene } = this, { theme } = scene;
    (this.machines ?? scene).draw(t);
    ctx.fillStyle = theme.paper;
    ctx.fillRect(0, 0, this.width, this.height);
    ctx.drawImage(scene.canvas, 0, 0, this.width, this.height);
    if (this.bare) return;
    ctx.textBaseline = 'top';
    ctx.fillStyle = theme.ink;
    ctx.font = `600 15px ${theme.sans}`;
    const phase = this.page.phase_at?.(t);
    ctx.fillText([`${t.toFixed(2).replace('-', '−')} s`, phase].filter(Boolean).join('  ·  '), 8, 7);
    if (this.machines) this.draw_names();
    if (this.speed === 1) return;
    ctx.fillStyle = theme.quiet;
    ctx.font = `13px ${theme.sans}`;
    ctx.textAlign = 'right';
    ctx.fillText(`${this.speed} ×`, this.width - 8, 8);
    ctx.textAlign = 'left';
  }

  // Draws the names of the runs: the first one in the text color, the others in the colors of their ghosts.
  draw_names() {
    const { ctx, scene: { theme } } = this, palette = theme.lines;
    ctx.font = `600 13px ${theme.sans}`;
    this.machines.runs.forEach((run, i) => {
      ctx.fillStyle = i ? palette[i % palette.length] : theme.ink;
      ctx.fillText(run.label, 8, 29 + 18 * i);
    });
  }

  pixels(t) {
    this.draw(t);
    return this.ctx.getImageData(0, 0, this.width, this.height).data;
  }

  async png(t) {
    this.draw(t);
    const file = await this.sheet.convertToBlob({ type: 'image/png' });
    return base64(new Uint8Array(await file.arrayBuffer()));
  }

  // Computes one palette for the whole film from frames at these times, so that unchanged parts keep their
// color.
  choose_palette(times) {
    const frames = times.map((t) => this.pixels(t));
    const all = new Uint8Array(frames.length * frames[0].length);
    frames.forEach((frame, i) => all.set(frame, i * frame.length));
    this.colors = quantize(all, 255);
    this.through = this.colors.length;  // transparent: the pixel is the same as in the frame before
    this.palette = [...this.colors, [255, 255, 255]];
    return this.colors.length;
  }

  // Returns the bytes that the frame adds to the file; `delay` in ms.
  gif_frame(t, delay) {
    const now = applyPalette(this.pixels(t), this.colors), { before } = this;
    const shown = before ? now.map((color, i) => (color === before[i] ? this.through : color)) : now;
    this.gif.writeFrame(shown, this.width, this.height, {
      palette: before ? undefined : this.palette, delay, transparent: Boolean(before), transparentIndex: this.through,
      dispose: 1, repeat: 0,
    });
    this.before = now;
    return this.new_bytes();
  }

  gif_end() {
    this.gif.finish();
    return this.new_bytes();
  }

  new_bytes() {
    const all = this.gif.bytesView(), out = base64(all.subarray(this.taken));
    this.taken = all.length;
    return out;
  }
}

// Returns the first and last time with data [s].
window.sinew_span = () => {
  const { run, page } = window.sinew;
  return run ? [run.phases.stretches[0]?.from ?? 0, run.duration] : page.whole;
};

// Returns the indices of the runs that can be drawn.
window.sinew_drawn = () => {
  const { machines, scene } = window.sinew.page;
  return machines ? machines.drawn : scene ? [0] : [];
};

window.sinew_film = (options) => {
  window.film = new Film(options);
  return true;
};
