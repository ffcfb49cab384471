// Saving pictures: their names, their two kinds, and what is told where it fails.
import { tell } from './sheet.js';

const sharpness = 3;  // pixels of a PNG for each unit of the picture

async function png_of(svg) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(sharpness * image.naturalWidth);
  canvas.height = Math.round(sharpness * image.naturalHeight);
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done, fail) => canvas.toBlob((b) => (b ? done(b) : fail(new Error('the browser makes no PNG of it'))), 'image/png'));
}

const longest = 40;  // of each part of a file's name

// "walk-test-1-joint-angles"
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
    tell(`${name} was not saved: ${error.message}`);
  }
}

// Entries of a menu. `of`: what the picture is of, as a run's name; `draw` returns it as SVG.
export const save_entries = (of, title, draw) => ['svg', 'png'].map((kind) =>
  [`Save as ${kind.toUpperCase()}`, () => save(`${file_name(of || 'run', title())}.${kind}`, kind, draw)]);
