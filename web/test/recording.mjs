// recording.mjs LENGTH   writes a recording of a braided muscle at a length [mm]: levels of pressure up and
//                        down, with the transitions between them
// recording.mjs rows     writes a table of the same muscle, in which two rows are wrong
// fit_page.mjs uses both.
const rate = 50, rest = 60, ramp = 12;  // [Hz], [samples]
const levels = [...Array(11).keys()].map((i) => 60 * i);
let state = 1000;
const noise = () => ((state = (state * 48271) % 2147483647) / 2147483647 - 0.5);

// Pressure in kPa, length in mm; filling is 1, venting -1.
const force = (length, pressure, branch) =>
  0.609 * Math.max(0, pressure - 6 * branch - 10) * (3 * (length / 284.7) ** 2 - 1) + 2 * noise();

function recording(length) {
  const path = [...levels, ...levels.slice(0, -1).reverse()], out = ['time [s],pressure [kPa gauge],force [N]'];
  const write = (p, branch) =>
    out.push([((out.length - 1) / rate).toFixed(2), (p + 0.6 * noise()).toFixed(3), force(length, p, branch).toFixed(3)].join());
  path.forEach((p, i) => {
    const before = path[i - 1] ?? 0, branch = p >= before ? 1 : -1;
    for (let j = 1; i && j <= ramp; ++j) write(before + ((p - before) * j) / ramp, branch);
    for (let j = 0; j < rest; ++j) write(p, branch);
  });
  return out;
}

function rows() {
  const out = ['length [mm],pressure [kPa gauge],force [N],branch'];
  for (const p of levels.slice(1))
    for (const branch of [1, -1]) {
      let measured = force(225, p, branch);
      if (p === 240 && branch < 0) measured *= 10;
      if (p === 540 && branch > 0) measured = force(200, p, branch);
      out.push([225, p, measured.toFixed(3), branch > 0 ? 'fill' : 'vent'].join());
    }
  return out;
}

const [what] = process.argv.slice(2);
state += Number(what) || 0;
console.log((what === 'rows' ? rows() : recording(Number(what))).join('\n'));
