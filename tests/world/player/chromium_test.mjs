// Chromium as the user: opens the player, plays, drags, switches, and sees pieces move and fire burn.
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {binary, brisance, chromiumFile, expect, finish, here, launch, place, serve, skipWithout, smallRun} from './world.mjs';

const fieryFrame = 4;
const patience = 120000;  // [ms] for a machine that does much else

skipWithout(chromiumFile, 'packaging/test.txt names it');
skipWithout(join(binary, '../../share/brisance/player.html'), 'the player was not built (packaging/build.txt: nodejs, npm)');

const run = smallRun();
const server = await serve(run);
const browser = await launch();
const said = [];

async function open(url, options) {
  const page = await browser.newPage({viewport: {width: 640, height: 400}, ...options});
  page.setDefaultTimeout(patience);
  page.on('console', message => { if (['error', 'warning'].includes(message.type())) said.push(message.text()); });
  page.on('pageerror', trouble => said.push(trouble.message));
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.ready);
  return page;
}
const frameOf = page => page.evaluate(() => Number(document.body.dataset.frame));
const slide = (page, id, value) => page.locator(`#${id}`).evaluate((slider, to) => {
  slider.value = to;
  slider.dispatchEvent(new Event('input'));
}, value);
const click = (page, id) => page.locator(`#${id}`).dispatchEvent('click');

/** Pixels of the view, from a picture drawn now, as small as the tests need them. */
async function pixels(page) {
  return page.evaluate(() => {
    const {player, stage} = window.brisance;
    player.putPoses();
    stage.setAtRest(false);  // pictures that are compared have as many pixels
    stage.draw(player.showsGas);
    const gl = stage.renderer.getContext(), bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return Array.from(bytes);
  });
}
function share(picture, counts) {
  let sum = 0;
  for (let n = 0; n < picture.length; n += 4) if (counts(n)) ++sum;
  return sum / (picture.length / 4);
}
const difference = (a, b) => share(a, n => Math.abs(a[n] - b[n]) + Math.abs(a[n + 1] - b[n + 1]) + Math.abs(a[n + 2] - b[n + 2]) > 40);
const fire = picture => share(picture, n => picture[n] > 150 && picture[n] > 1.25 * picture[n + 1] && picture[n + 1] > 1.1 * picture[n + 2]);

async function showFrame(page, frame) {
  await page.evaluate(number => window.brisance.player.seek(number - 1), frame);
  await page.waitForFunction(number => window.brisance.player.drawn.gas === number - 1 && window.brisance.player.drawn.frame === number - 1, frame);
}

async function playsAndSeeks(page) {
  await page.keyboard.press('Space');
  await page.waitForFunction(() => Number(document.body.dataset.frame) > 2);
  expect(true, 'space plays');
  await page.keyboard.press('Space');
  expect(!(await page.evaluate(() => window.brisance.player.isPlaying)), 'space pauses');
  await click(page, 'play');
  expect(await page.evaluate(() => window.brisance.player.isPlaying), 'the button plays');
  const box = await page.locator('#time').boundingBox();
  await page.mouse.move(box.x + 8, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, {steps: 3});
  await page.mouse.up();
  await page.waitForFunction(() => [6, 7].includes(Number(document.body.dataset.frame)));
  expect(!(await page.evaluate(() => window.brisance.player.isPlaying)), 'dragging the slider to the middle shows the middle frame and pauses');
  const before = await frameOf(page);
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction(frame => Number(document.body.dataset.frame) === frame + 1, before);
  await page.keyboard.press('End');
  await page.waitForFunction(() => Number(document.body.dataset.frame) === 12);
  expect(true, 'arrows and end go to their frames');
}

async function showsFireAndMovingPieces(page) {
  await page.waitForFunction(() => window.brisance.moments.known.filter(Boolean).length === 12);
  await showFrame(page, fieryFrame);
  const burning = await pixels(page);
  await click(page, 'showGas');
  const without = await pixels(page);
  expect(fire(burning) > fire(without) + 0.01, `fire is seen: ${fire(burning).toFixed(3)} of the picture against ${fire(without).toFixed(3)} without gas`);
  await showFrame(page, 10);
  const later = await pixels(page);
  expect(difference(without, later) > 0.02, `pieces move: ${difference(without, later).toFixed(3)} of the picture differs`);
  for (const [number, name] of [[1, 'piece'], [2, 'speed'], [3, 'heat']]) {
    await page.locator(`#colouring [data-value="${number}"]`).dispatchEvent('click');
    const coloured = await pixels(page);
    expect(difference(later, coloured) > 0.01, `colouring by ${name} changes the pieces: ${difference(later, coloured).toFixed(3)}`);
  }
  await page.locator('#colouring [data-value="0"]').dispatchEvent('click');
  expect(difference(later, await pixels(page)) < 0.001, 'colouring by material is as before');
  await slide(page, 'explode', 1.5);
  expect(difference(later, await pixels(page)) > 0.02, 'the exploded view takes the pieces apart');
  await slide(page, 'explode', 0);
  await click(page, 'showGas');
}

/** A piece in the gas hides what of it lies behind. */
async function gasStopsAtPieces(page) {
  await showFrame(page, 3);
  const whole = await pixels(page);
  await page.evaluate(() => { for (const mesh of window.brisance.stage.pieces.solids) mesh.visible = false; });
  const bare = await pixels(page);
  await page.evaluate(() => { for (const mesh of window.brisance.stage.pieces.solids) mesh.visible = true; });
  expect(difference(whole, bare) > 0.05, 'pieces are seen in the gas');
}

async function orbits(page) {
  const before = await pixels(page);
  await page.mouse.move(250, 200);
  await page.mouse.down();
  await page.mouse.move(330, 220, {steps: 4});
  await page.mouse.up();
  await page.waitForFunction(() => !window.brisance.stage.followsFilm);
  expect(difference(before, await pixels(page)) > 0.05, 'dragging orbits');
}

async function fitsAPhone(url) {
  const page = await open(url, {viewport: {width: 390, height: 844}, hasTouch: true, isMobile: true});
  const outside = await page.evaluate(() => {
    document.getElementById('panelButton').click();
    return [...document.querySelectorAll('button, input, select')].filter(control => {
      const box = control.getBoundingClientRect();
      return box.width > 0 && control.checkVisibility() && !control.closest('dialog') && !control.closest('.switches')
        && (box.left < -1 || box.right > innerWidth + 1);
    }).map(control => control.id || control.textContent);
  });
  expect(outside.length === 0, `all controls fit a phone's width ${outside}`);
  expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing scrolls sideways');
  await page.locator('#play').tap();
  expect(await page.evaluate(() => window.brisance.player.isPlaying), 'a tap plays');
  await page.close();
}

async function growsWithTheRun(url) {
  const page = await browser.newPage({viewport: {width: 640, height: 400}});
  page.setDefaultTimeout(patience);
  let frames = 3;
  await page.route('**/data/state.json', route => route.fulfill({json: {frames, planned: 12}}));
  await page.goto(url);
  await page.waitForFunction(() => window.brisance?.moments.count === 3);
  const saysSo = await page.locator('#live').waitFor({state: 'visible'}).then(() => true, () => false);
  expect(saysSo, 'a run that goes on is said to be live');
  frames = 12;
  await page.waitForFunction(() => window.brisance.moments.known.filter(Boolean).length === 12);
  await page.waitForFunction(() => document.getElementById('live').hidden);
  expect(true, 'frames that come later are played as well');
  await page.close();
}

async function followsARunThatTakesThePlaceOfAnother() {
  const changing = join(place, 'changing');
  const simulate = (...words) => brisance('simulate', join(here, 'small.toml'), '-o', changing, '--quiet', '--set', 'scene.frames=4', ...words);
  simulate();
  const own = await serve(changing);
  const bytesOfLast = async () => Buffer.from(await (await fetch(`${own.url}data/moments/4`)).arrayBuffer()).toString('base64');
  const speedOfLast = page => page.evaluate(() => Math.max(...(window.brisance?.moments.known[3]?.poses.speed ?? [0])));
  const page = await open(own.url);
  await page.waitForFunction(() => window.brisance.moments.known[3]);
  const before = [await bytesOfLast(), await speedOfLast(page)];
  simulate('--overwrite', '--set', 'rigid.push.force_constant=900');
  expect(await bytesOfLast() !== before[0], 'a frame of a run that was overwritten is made anew');
  await page.waitForFunction(speed => {
    const known = window.brisance?.moments.known[3];
    return known && Math.max(...known.poses.speed) !== speed;
  }, before[1], {polling: 200});
  expect(true, 'the page goes on with the run that took the place of another');
  await page.close();
  await own.stop();
}

async function oneFileNeedsNoServer() {
  const file = join(place, 'player.html');
  brisance('export', run, '--to', 'html', '-o', file, '--quiet');
  const page = await open(pathToFileURL(file).href);
  await page.waitForFunction(() => window.brisance.moments.known.filter(Boolean).length === 12);
  await showFrame(page, fieryFrame);
  expect(fire(await pixels(page)) > 0.01, 'the player in one file shows the fire');
  await page.close();
}

async function saysWhatIsMissing(url) {
  const bare = await launch(['--disable-gpu', '--disable-software-rasterizer', '--disable-3d-apis']);
  const page = await bare.newPage();
  page.setDefaultTimeout(patience);
  await page.goto(url);
  await page.waitForFunction(() => !document.getElementById('message').hidden);
  const text = await page.locator('#message').textContent();
  expect(/WebGL 2 is missing/.test(text), `without WebGL 2: ${text.slice(0, 60)}...`);
  await bare.close();
}

try {
  const page = await open(server.url);
  console.log(`first picture after ${await page.evaluate(() => document.body.dataset.started)} ms, with gas after ${await page.evaluate(() => document.body.dataset.ready)} ms`);
  await playsAndSeeks(page);
  await showsFireAndMovingPieces(page);
  await gasStopsAtPieces(page);
  await orbits(page);
  await page.close();
  await fitsAPhone(server.url);
  await growsWithTheRun(server.url);
  await followsARunThatTakesThePlaceOfAnother();
  await oneFileNeedsNoServer();
  await saysWhatIsMissing(server.url);
  expect(said.length === 0, `the console stays silent ${said.slice(0, 3)}`);
} catch (trouble) {
  expect(false, trouble.stack);
} finally {
  await browser.close();
  await server.stop();
}
finish();
