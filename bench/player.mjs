// The player's figures on software rendering, as Chromium's user has them: start, script, bytes, and the longest time
// between two pictures while it plays, is turned and coloured. Needs no graphics card; wants a quiet machine.
//   node bench/player.mjs build/release/bin/brisance build/release/viewer RUN [SECONDS]
import {spawn} from 'node:child_process';
import {createRequire} from 'node:module';
import {join, resolve} from 'node:path';
import {gzipSync} from 'node:zlib';

const [binary, packages, run, seconds = '60'] = process.argv.slice(2);
const {chromium} = createRequire(join(resolve(packages), 'package.json'))('playwright-core');
const server = spawn(binary, ['view', run, '--quiet'], {stdio: ['ignore', 'pipe', 'inherit']});
const url = await new Promise(done => server.stdout.once('data', text => done(String(text).trim())));
const browser = await chromium.launch({
  executablePath: '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

/** Gaps between the turns in which the page may draw, from now on. [ms] */
function watch() {
  const gaps = window.gaps = {pictures: [], before: performance.now()};
  const turn = now => {
    gaps.pictures.push(now - gaps.before);
    gaps.before = now;
    requestAnimationFrame(turn);
  };
  requestAnimationFrame(now => {
    gaps.before = now;
    requestAnimationFrame(turn);
  });
}

async function interact(page, until) {
  const box = await page.locator('#view').boundingBox();
  await page.keyboard.press('Space');
  for (let n = 0; Date.now() < until; ++n) {
    await page.keyboard.press(['2', '3', '4', '1'][n % 4]);
    await page.mouse.move(box.x + 300, box.y + 300);
    await page.mouse.down();
    for (let k = 0; k < 10; ++k) await page.mouse.move(box.x + 300 + 6 * k * (n % 2 ? -1 : 1), box.y + 300 + 2 * k);
    await page.mouse.up();
    if (n % 3 === 2) await page.keyboard.press('x');
    if (n % 5 === 4) await page.keyboard.press('p');
    await page.waitForTimeout(1500);
    if (!(await page.evaluate(() => window.brisance.player.isPlaying))) await page.keyboard.press('Space');
  }
}

try {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}});
  page.setDefaultTimeout(120000);
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.ready);
  const {started, ready} = await page.evaluate(() => ({...document.body.dataset}));
  console.log(`first picture after ${started} ms, with gas after ${ready} ms`);
  await page.waitForFunction(() => window.brisance.moments.known.filter(Boolean).length === window.brisance.moments.count);
  const {bytes, count, bodies} = await page.evaluate(() => (
    {bytes: window.brisance.moments.bytes, count: window.brisance.moments.count, bodies: window.brisance.player.run.bodies.length}));
  const [html, glb] = await Promise.all(['', 'data/pieces.glb'].map(async name => Buffer.from(await (await fetch(url + name)).arrayBuffer())));
  const script = html.toString().match(/<script type="module">([^]*)<\/script>/)[1];
  console.log(`script ${(gzipSync(script, {level: 9}).length / 1000).toFixed(0)} kB gzipped; ${bodies} bodies, ${count} frames: ` +
    `${((bytes + html.length + glb.length) / 1e6).toFixed(1)} MB; of 240 frames ${((bytes * 240 / count + html.length + glb.length) / 1e6).toFixed(1)} MB`);
  await page.evaluate(watch);
  await interact(page, Date.now() + 1000 * Number(seconds));
  const pictures = (await page.evaluate(() => window.gaps.pictures)).sort((a, b) => a - b);
  const share = part => pictures[Math.min(pictures.length - 1, Math.floor(part * pictures.length))].toFixed(0);
  const {width, quality} = await page.evaluate(() => ({width: window.brisance.stage.solidLayer.width, quality: window.brisance.stage.quality}));
  console.log(`${seconds} s of play and interaction: ${pictures.length} turns; between two, median ${share(0.5)} ms, 99 % ${share(0.99)} ms, longest ${share(1)} ms; ` +
    `${pictures.filter(gap => gap > 500).length} above 500 ms; ${width} pixels wide at the end (quality ${quality})`);
} finally {
  await browser.close();
  server.kill('SIGINT');
}
