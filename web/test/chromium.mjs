// Browser without window and network: Debian's chromium, or the file in CHROMIUM. Of those installed,
// chromium-headless-shell is tried first, since it is the fastest.
import { accessSync, constants } from 'node:fs';
import { dirname, join } from 'node:path';
import { chromium } from 'playwright-core';

function executable() {
  if (process.env.CHROMIUM) return process.env.CHROMIUM;
  for (const folder of process.env.PATH.split(':'))
    for (const name of ['chromium-headless-shell', 'chromium', 'chromium-browser', 'google-chrome']) {
      const file = join(folder, name);
      try {
        accessSync(file, constants.X_OK);
        return file;
      } catch {}
    }
  throw new Error('no chromium on the PATH; try: apt-get install chromium, or CHROMIUM=<its file>');
}

export async function open_browser() {
  return chromium.launch({ executablePath: executable(), args: ['--no-sandbox', '--disable-dev-shm-usage'] });
}

// Opens a page and records errors in `page.wrong`: console messages, exceptions, requests of other files.
// `own_folder`: the page may load pictures from its own folder.
export async function open_page(browser, file, { own_folder = false, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, offline: true, ...options });
  const page = await context.newPage();
  page.wrong = [];
  page.on('console', (m) => ['error', 'warning'].includes(m.type()) && page.wrong.push(`${m.type()}: ${m.text()}`));
  page.on('pageerror', (e) => page.wrong.push(`exception: ${e.message}`));
  const its_own = (url) => url === `file://${file}` || (own_folder && url.startsWith(`file://${dirname(file)}/`));
  page.on('request', (r) => its_own(r.url()) || page.wrong.push(`requested ${r.url().slice(0, 100)}`));
  page.started = Date.now();
  await page.goto(`file://${file}`);
  await page.waitForSelector('html[data-ready]', { timeout: 60000 });
  page.took = Date.now() - page.started;
  return page;
}
