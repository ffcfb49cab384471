// A study that still grows: asks the program for rows that are new, a second after the last answer.
import { by_id } from './page.js';

const again_after = 1000;  // [ms]

export class Growing {
  constructor(page) {
    this.page = page;
    this.known = [...page.run.known];  // of each study: changes of rows that the program has told
    this.answers = 0;
    this.wait();
  }

  wait() {
    setTimeout(() => this.ask(), again_after);
  }

  async ask() {
    try {
      for (const study of this.page.data.studies) {
        const answer = await fetch(new URL(`${study.path}rows/${this.known[study.study]}`, location.href));
        if (!answer.ok) throw new Error(answer.statusText);
        this.take(study, await answer.json());
      }
      by_id('lost').hidden = true;
    } catch {
      by_id('lost').hidden = false;
    }
    this.wait();
  }

  take(study, { known, rows, expected, error }) {
    ++this.answers;
    by_id('lost').textContent = error ?? 'The program that serves this page is gone; what was there stays.';
    if (error) throw new Error(error);
    const { data } = this.page;
    this.known[study.study] = known;
    if (!rows.length && expected === study.expected) return;
    study.expected = expected;
    const kinds = () => data.columns.map((c) => `${c.varies}${c.words.length}`).join();
    const before = kinds();
    data.add(study, rows);
    const changed = kinds() !== before;
    if (changed) this.page.parallel.choose_first();
    this.page.grown(changed);
    const { chosen } = this.page;
    if (chosen >= 0 && data.study[chosen] === study.study && rows.some((r) => r[0] === data.number[chosen])) this.page.side.draw();
  }
}
