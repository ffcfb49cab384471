// Saves pictures as SVG or PNG, and reports errors.
import { show_message } from './dialog.js';

const sharpness = 3;  // pixels of a PNG for each unit of the picture

async function png_of(svg) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(sharpness * image.naturalWidth);
  canvas.height = Math.round(sharpness * image.naturalHeight);
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done, fail) => canvas.toBlob((b) => (b ? done(b) : fail(new Error('the browser could not convert the picture to PNG'))), 'image/png'));
}

const longest = 40;  // characters of each part of a file name

// Returns a name such as "walk-test-1-joint-angles".
const file_name = (...parts) => parts.map((words) =>
  words.toLowerCase().replace(/[^a-z0-9]+/g, '-').slice(0, longest).replace(/^-+|-+$/g, '')).filter(Boolean).join('-');

function save_as(name, blob) {
  const link = document.createElement('a'), url = URL.createObjectURL(blob);
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

async function save(name, kind, draw) {
  try {
    const svg = draw();
    save_as(name, kind === 'svg' ? new Blob([svg], { type: 'image/svg+xml' }) : await png_of(svg));
  } catch (error) {
    show_message(`${name} was not saved: ${error.message}`);
  }
}

// Returns the entries of a menu. `of`: name of the run; `draw` returns the picture as SVG.
export const save_entries = (of, title, draw) => ['svg', 'png'].map((kind) =>
  [`Save as ${kind.toUpperCase()}`, () => save(`${file_name(of || 'run', title())}.${kind}`, kind, draw)]);
