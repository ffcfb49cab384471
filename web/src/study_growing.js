// A study that still grows: asks the program for rows that are new, a second after the last answer.
import { by_id } from './page.js';

const again_after = 1000;  // [ms]

export class Growing {
  constructor(page) {
    this.page = page;
    this.known = page.run.known;  // changes of rows that the program has told
    this.answers = 0;
    this.wait();
  }

  wait() {
    setTimeout(() => this.ask(), again_after);
  }

  async ask() {
    try {
      const answer = await fetch(new URL(`rows/${this.known}`, location.href));
      if (!answer.ok) throw new Error(answer.statusText);
      this.take(await answer.json());
      by_id('lost').hidden = true;
    } catch {
      by_id('lost').hidden = false;
    }
    this.wait();
  }

  take({ known, rows, expected, error }) {
    ++this.answers;
    by_id('lost').textContent = error ?? 'The program that serves this page is gone; what was there stays.';
    if (error) throw new Error(error);
    const { data } = this.page, [study] = data.studies;
    this.known = known;
    if (!rows.length && expected === study.expected) return;
    study.expected = expected;
    const kinds = () => data.columns.map((c) => `${c.varies}${c.words.length}`).join();
    const before = kinds();
    data.add(study, rows);
    const changed = kinds() !== before;
    if (changed) this.page.parallel.choose_first();
    this.page.grown(changed);
    if (this.page.chosen >= 0 && rows.some((r) => r[0] === data.number[this.page.chosen])) this.page.side.draw();
  }
}
