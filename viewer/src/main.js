// The player begins: what is asked for first, and what is said when something is missing.
import {Controls} from './controls.js';
import {Moments} from './moments.js';
import {readBodies} from './pieces.js';
import {Player} from './player.js';
import {parsed, Source} from './source.js';
import {contextAttributes, Stage} from './stage.js';

const pollSeconds = 1, calmPollSeconds = 5;  // while the run goes on, and once it is whole

function say(title, text) {
  const message = document.getElementById('message');
  message.replaceChildren(Object.assign(document.createElement('b'), {textContent: title}), text);
  message.hidden = false;
}
const saidNothing = () => { document.getElementById('message').hidden = true; };

/** What this browser lacks; nothing if all is there. */
function lackOf(gl) {
  if (!gl) return 'WebGL 2 is missing. The player draws with it: switch on graphics acceleration in this browser, or open the page in another (Chrome, Edge and Firefox have it, Safari from 15).';
  if (!gl.getExtension('EXT_color_buffer_float')) return 'Pictures of floating-point numbers (EXT_color_buffer_float) are missing in this browser’s WebGL 2. Another browser or newer graphics driver has them.';
  if (typeof DecompressionStream === 'undefined') return 'This browser is too old to unpack the run (DecompressionStream is missing). Any of 2023 or later will do.';
  return null;
}

function showTitle(run) {
  document.title = `${run.title} – Brisance`;
  document.getElementById('title').textContent = run.title;
  if (run.timeScale !== 1) {
    const note = Object.assign(document.createElement('small'), {textContent: `${run.timeScale}× time`});
    document.getElementById('title').append(note);
  }
}

/** Calls back when the card has done all that it was told until now. */
function whenDrawn(gl, done) {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  const waiting = setInterval(() => {
    if (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) return;
    clearInterval(waiting);
    gl.deleteSync(fence);
    done();
  }, 10);
}

/** The run is asked how far it is, and whether it is still the same. */
async function poll(source, moments, trouble) {
  try {
    moments.grow(await source.json('state.json'));
    trouble(null);
  } catch {
    trouble('The player’s server does not answer any more. What has arrived can still be played.');
  }
  document.getElementById('live').hidden = !moments.isGrowing;
  if (source.isEmbedded) return;
  setTimeout(() => poll(source, moments, trouble), 1000 * (moments.isGrowing ? pollSeconds : calmPollSeconds));
}

/** Lets the browser start its drawing in a thread of its own: the page's first context, which would wait for that, comes sooner. */
function warmUp() {
  const text = `new OffscreenCanvas(1, 1).getContext('webgl2')`;
  new Worker(URL.createObjectURL(new Blob([text], {type: 'text/javascript'})));
}

async function begin() {
  performance.mark('script');
  const source = new Source();
  const asked = ['run.json', 'state.json', 'pieces.glb'].map(name => source.bytes(name));
  asked.forEach(answer => answer.catch(() => {}));  // told of below
  warmUp();
  const bodies = await readBodies(await asked[2]);
  performance.mark('glb');
  const canvas = document.getElementById('view');
  const gl = canvas.getContext('webgl2', contextAttributes);
  performance.mark('context');
  const lack = lackOf(gl);
  if (lack) return say('This browser cannot show the run', lack);
  const [run, state] = await Promise.all(asked.slice(0, 2).map(async bytes => parsed(await bytes)));
  performance.mark('described');
  showTitle(run);
  const moments = new Moments(source, run);
  moments.grow(state);
  const stage = new Stage(canvas, gl, run);
  performance.mark('stage');
  stage.load(bodies);
  performance.mark('pieces');
  const player = new Player(stage, moments, run, source);
  player.onFirst = () => {
    saidNothing();
    performance.mark('told');
    whenDrawn(gl, () => { document.body.dataset.started = Math.round(performance.now()); });
  };
  player.onWhole = () => whenDrawn(gl, () => { document.body.dataset.ready = Math.round(performance.now()); });
  const controls = new Controls(player);
  window.brisance = {player, moments, stage, controls};
  let drawn = 0;
  moments.listeners.arrived = (place, moment) => {
    controls.learnRange(moment);
    controls.showLoaded();
    if (place === player.frame || place === player.frame + 1) player.isDirty = true;
    if (performance.now() - drawn > 500 || moments.known.filter(Boolean).length === moments.count) {
      drawn = performance.now();
      controls.drawGraphs();
    }
  };
  moments.listeners.trouble = text => console.warn(text);
  moments.known.forEach((moment, place) => moment && moments.listeners.arrived(place, moment));
  await poll(source, moments, text => (text ? console.warn(text) : undefined));
  if (moments.count === 0) say('No frame is there yet', 'The run has only begun; the first frame will appear here.');
}

begin().catch(trouble => say('The run cannot be shown', String(trouble.message ?? trouble)));
