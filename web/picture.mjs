// picture.mjs REPORT PICTURE [SECONDS] [dark] [HEIGHT]   takes a screenshot of a page at a time of the replay; on
// the page of a study SECONDS is the row to choose. It makes report.png, fit.png and study.png in docs/pictures.
import { resolve } from 'node:path';
import { open_browser, open_page } from './test/chromium.mjs';

const [report, picture, seconds = '0', scheme = 'light', height = '850'] = process.argv.slice(2);
if (!picture) throw new Error('usage: picture.mjs REPORT PICTURE [SECONDS] [dark] [HEIGHT]');
const browser = await open_browser();
const page = await open_page(browser, resolve(report), { colorScheme: scheme, viewport: { width: 1440, height: Number(height) } });
await page.evaluate((t) => (window.sinew.page.seek ?? window.sinew.page.choose)?.call(window.sinew.page, t), Number(seconds));
await page.waitForTimeout(300);  // the plots are redrawn in the next frames
await page.screenshot({ path: picture });
await browser.close();
