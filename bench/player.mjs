// The player's figures on software rendering, as Chromium's user has them: start, script, bytes, and the longest time
// between two pictures while it plays, is turned, coloured and dragged through. Needs no graphics card; wants a quiet
// machine. An empty page with a WebGL 2 context is opened first, each time: what the machine itself takes just then.
//   node bench/player.mjs build/release/bin/brisance build/release/viewer [RUN [SECONDS [TIMES]]]
// Without RUN one of 512 shards in 96^3 cells is made in the system's folder for temporary files, and kept there.
import {execFileSync, spawn} from 'node:child_process';
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import {loadavg, tmpdir} from 'node:os';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';

const [binary, packages, given, seconds = '60', times = '3'] = process.argv.slice(2);
const {chromium} = createRequire(join(resolve(packages), 'package.json'))('playwright-core');
const settle = 2000;  // [ms] until the browser has opened its own windows
const whole = 240;    // frames of a film

/** 512 shards before a gas of 96^3 cells. */
function ownRun() {
  const run = join(tmpdir(), 'brisance_player_bench');
  if (existsSync(join(run, 'run.json'))) return run;
  const scene = join(dirname(fileURLToPath(import.meta.url)), '../scenes/window_closeup.toml');
  execFileSync(binary, ['simulate', scene, '-o', run, '--overwrite', '--set', 'gas.cells=[96, 96, 96]', '--set', 'scene.frames=60'],
    {stdio: 'inherit'});
  return run;
}

async function serve(run) {
  const server = spawn(binary, ['view', run, '--quiet'], {stdio: ['ignore', 'pipe', 'inherit']});
  return {server, url: await new Promise(done => server.stdout.once('data', text => done(String(text).trim())))};
}

const launch = () => chromium.launch({
  executablePath: '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

/** [ms] until a page that does nothing but clear a WebGL 2 picture has drawn it. */
async function emptyPage(url) {
  const browser = await launch();
  try {
    const page = await browser.newPage({viewport: {width: 1280, height: 800}});
    await page.waitForTimeout(settle);
    await page.route('**/*', route => route.fulfill({contentType: 'text/html', body: `<canvas></canvas><script>
      const gl = document.querySelector('canvas').getContext('webgl2');
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      document.title = Math.round(performance.now());</script>`}));
    await page.goto(url);
    return Number(await page.title());
  } finally {
    await browser.close();
  }
}

/** Gaps between the turns in which the page may draw, and pictures that were drawn, from now on; in the page. [ms] */
function watch() {
  const seen = window.seen = {turns: [], pictures: [], tasks: []};
  let before = performance.now(), drawn = before;
  const turn = now => {
    seen.turns.push(now - before);
    before = now;
    requestAnimationFrame(turn);
  };
  requestAnimationFrame(now => {
    before = drawn = now;
    requestAnimationFrame(turn);
  });
  new PerformanceObserver(list => seen.tasks.push(...list.getEntries().map(task => task.duration))).observe({type: 'longtask'});
  const {stage} = window.brisance, draw = stage.draw;
  stage.draw = showsGas => {
    const now = performance.now();
    seen.pictures.push(now - drawn);
    drawn = now;
    draw.call(stage, showsGas);
  };
}

async function drag(page, from, to) {
  await page.mouse.move(...from);
  await page.mouse.down();
  for (let k = 1; k <= 10; ++k) await page.mouse.move(...from.map((at, axis) => at + ((to[axis] - at) * k) / 10));
  await page.mouse.up();
}

/** Colours, turns the camera, drags through time, explodes; it plays in between. */
async function interact(page, until) {
  const view = await page.locator('#view').boundingBox(), time = await page.locator('#time').boundingBox();
  for (let n = 0; Date.now() < until; ++n) {
    if (!(await page.evaluate(() => window.brisance.player.isPlaying))) await page.keyboard.press('Space');
    await page.keyboard.press(['2', '3', '4', '1'][n % 4]);
    const corner = [view.x + 300, view.y + 300];
    await drag(page, corner, [corner[0] + (n % 2 ? -60 : 60), corner[1] + 20]);
    if (n % 3 === 2) await page.keyboard.press('x');
    if (n % 5 === 4) await page.keyboard.press('p');
    if (n % 4 === 3) await drag(page, [time.x + 0.2 * time.width, time.y + time.height / 2], [time.x + 0.8 * time.width, time.y + time.height / 2]);
    await page.waitForTimeout(1500);
  }
}

/** The run is there as a whole: what went over the wire for it. */
async function weigh(page, url) {
  await page.waitForFunction(() => window.brisance?.moments.known.filter(Boolean).length === window.brisance?.moments.count, null, {polling: 200});
  const {bytes, count, bodies} = await page.evaluate(() => (
    {bytes: window.brisance.moments.bytes, count: window.brisance.moments.count, bodies: window.brisance.player.run.bodies.length}));
  const [html, glb] = await Promise.all(['', 'data/pieces.glb'].map(async name => Buffer.from(await (await fetch(url + name)).arrayBuffer())));
  const script = html.toString().match(/<script type="module">([^]*)<\/script>/)[1];
  const rest = html.length + glb.length;
  return {script: gzipSync(script, {level: 9}).length / 1000, bodies, count, megabytes: (bytes + rest) / 1e6,
    megabytesOfFilm: (bytes * whole / count + rest) / 1e6};
}

async function once(url) {
  const empty = await emptyPage(url);
  const browser = await launch();
  try {
    const page = await browser.newPage({viewport: {width: 1280, height: 800}});
    page.setDefaultTimeout(120000);
    await page.waitForTimeout(settle);
    await page.goto(url);
    await page.waitForFunction(() => document.body.dataset.ready, null, {polling: 100});
    const {started, ready} = await page.evaluate(() => ({...document.body.dataset}));
    const marks = await page.evaluate(() => performance.getEntriesByType('mark').map(mark => `${mark.name} ${Math.round(mark.startTime)}`).join(', '));
    const weight = await weigh(page, url);
    await page.evaluate(watch);
    await interact(page, Date.now() + 1000 * Number(seconds));
    const seen = await page.evaluate(() => window.seen);
    const end = await page.evaluate(() => ({width: window.brisance.stage.solidLayer.width, quality: window.brisance.stage.quality}));
    return {empty, started: Number(started), ready: Number(ready), marks, ...weight, ...end, ...seen};
  } finally {
    await browser.close();
  }
}

const share = (values, part) => {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))] ?? 0;
};
const rounded = value => Math.round(value);

function tell(seen) {
  const {turns, pictures, tasks} = seen;
  console.log(`an empty page ${seen.empty} ms; first picture ${seen.started} ms, with fire ${seen.ready} ms (${seen.marks})`);
  console.log(`${seconds} s of play and interaction: ${pictures.length} pictures; ${turns.length} turns, median ${rounded(share(turns, 0.5))} ms, ` +
    `99 % ${rounded(share(turns, 0.99))} ms, longest ${rounded(share(turns, 1))} ms, ${turns.filter(gap => gap > 500).length} above 500 ms; ` +
    `longest task ${rounded(share(tasks, 1))} ms; ${seen.width} pixels wide at the end (quality ${seen.quality}); load ${loadavg()[0].toFixed(1)}`);
}

const {server, url} = await serve(given ?? ownRun());
try {
  const all = [];
  for (let n = 0; n < Number(times); ++n) {
    all.push(await once(url));
    tell(all[n]);
  }
  const median = name => rounded(share(all.map(seen => seen[name]), 0.49));
  const longest = rounded(share(all.map(seen => share(seen.turns, 1)), 0.49));
  const {script, bodies, count, megabytes, megabytesOfFilm} = all[0];
  console.log(`median of ${times}: empty page ${median('empty')} ms, first picture ${median('started')} ms, with fire ${median('ready')} ms, longest turn ${longest} ms`);
  console.log(`script ${script.toFixed(0)} kB gzipped; ${bodies} bodies, ${count} frames: ${megabytes.toFixed(1)} MB; of ${whole} frames ${megabytesOfFilm.toFixed(1)} MB`);
} finally {
  server.kill('SIGINT');
}
