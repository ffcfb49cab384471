// notebook_offline.mjs CELL   what a notebook's cell shows of a walk, in a browser without a network:
// the machine is drawn and moves, nothing is asked of anywhere, nothing fails.
import { pathToFileURL } from 'node:url';

import { open_browser } from '../../web/test/chromium.mjs';

const browser = await open_browser();
const wrong = [];
try {
  const context = await browser.newContext({ offline: true });
  const page = await context.newPage();
  page.on('pageerror', (error) => wrong.push(`error: ${error.message}`));
  page.on('request', (asked) => /^(https?|wss?):/.test(asked.url()) && wrong.push(`asked for ${asked.url()}`));
  await page.goto(pathToFileURL(process.argv[2]).href);
  const frame = page.frames().find((f) => f !== page.mainFrame()) ?? page.mainFrame();
  await frame.waitForSelector('canvas', { timeout: 20000 });
  const drawn = () => frame.evaluate(() => document.querySelector('canvas').toDataURL());
  await page.waitForTimeout(500);
  const first = await drawn();
  await frame.locator('input[type=range]').first().press('End');
  await page.waitForTimeout(500);
  if (first.length < 2000) wrong.push('the drawing is empty');
  if ((await drawn()) === first) wrong.push('the drawing stays as it is when its time is moved');
} finally {
  await browser.close();
}
if (wrong.length) throw new Error(wrong.join('; '));
console.log('notebook: a cell shows the walk, which moves, without a network');
