// picture.mjs REPORT PICTURE [SECONDS] [dark] [HEIGHT]   a page as it stands at a time, a study's with that
// row chosen: docs/pictures/report.png, docs/pictures/fit.png, docs/pictures/study.png.
import { resolve } from 'node:path';
import { open_browser, open_page } from './test/chromium.mjs';

const [report, picture, seconds = '0', scheme = 'light', height = '850'] = process.argv.slice(2);
if (!picture) throw new Error('usage: picture.mjs REPORT PICTURE [SECONDS] [dark] [HEIGHT]');
const browser = await open_browser();
const page = await open_page(browser, resolve(report), { colorScheme: scheme, viewport: { width: 1440, height: Number(height) } });
await page.evaluate((t) => (window.sinew.page.seek ?? window.sinew.page.choose)?.call(window.sinew.page, t), Number(seconds));
await page.waitForTimeout(300);  // the plots follow in the next frames
await page.screenshot({ path: picture });
await browser.close();
