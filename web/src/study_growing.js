// Updates of a study in progress: requests new rows from the program one second after the last reply.
import { by_id } from './page.js';

const again_after = 1000;  // [ms]

export class Growing {
  constructor(page) {
    this.page = page;
    this.known = [...page.run.known];  // changes of rows received so far, for each study
    this.replies = 0;
    this.wait();
  }

  wait() {
    setTimeout(() => this.request_rows(), again_after);
  }

  async request_rows() {
    try {
      for (const study of this.page.data.studies) {
        const reply = await fetch(new URL(`${study.path}rows/${this.known[study.study]}`, location.href));
        if (!reply.ok) throw new Error(reply.statusText);
        this.take(study, await reply.json());
      }
      by_id('lost').hidden = true;
    } catch {
      by_id('lost').hidden = false;
    }
    this.wait();
  }

  take(study, { known, rows, expected, error }) {
    ++this.replies;
    by_id('lost').textContent = error ?? 'The program that serves this page has ended; rows loaded so far stay visible.';
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
