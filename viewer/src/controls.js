// Buttons, sliders and keys.
import {colourOfSeries, drawGraph, graphs, shortNumber} from './graphs.js';

const element = id => document.getElementById(id);
const colouringNames = ['Material', 'Piece', 'Speed', 'Heat'];

export class Controls {
  /** @param {import('./player.js').Player} player */
  constructor(player) {
    this.player = player;
    this.moments = player.moments;
    this.graph = 'volume';
    this.shownFrame = -1;
    this.graphsDrawn = -Infinity;  // [ms]
    this.fastest = 1;
    this.coldest = Infinity;
    this.hottest = -Infinity;
    this.bindTime();
    this.bindPanel();
    this.bindGraphs();
    addEventListener('keydown', event => this.key(event));
    addEventListener('resize', () => {
      player.stage.resize();
      player.isDirty = true;
      this.drawGraphs();
    });
    player.onFrame = () => this.show();
    player.onPlaying = () => document.body.classList.toggle('isPlaying', player.isPlaying);
    player.onCamera = () => this.choose('cameraChoice', player.stage.followsFilm ? 'film' : 'free');
    player.stage.setColouring(0);
    this.showPanel(innerWidth > 640);
  }

  bindTime() {
    const {player} = this;
    element('play').onclick = () => player.setPlaying(!player.isPlaying);
    element('previous').onclick = () => player.step(-1);
    element('following').onclick = () => player.step(1);
    element('time').oninput = event => {
      player.setPlaying(false);
      player.seek(Math.round(Number(event.target.value)));
    };
    element('speed').onchange = event => { player.speed = Number(event.target.value); };
    element('loop').onclick = () => this.toggleLoop();
  }

  toggleLoop() {
    this.player.loops = !this.player.loops;
    element('loop').setAttribute('aria-pressed', this.player.loops);
  }

  bindPanel() {
    const {player} = this, {stage} = player;
    const dirty = action => event => {
      action(event.target);
      player.isDirty = true;
    };
    this.bindChoice('colouring', value => this.setColouring(Number(value)));
    this.bindChoice('cameraChoice', value => { stage.followsFilm = value === 'film'; });
    element('explode').oninput = dirty(slider => this.setExplode(Number(slider.value)));
    element('showGas').onchange = dirty(box => { player.showsGas = box.checked; });
    element('showPoints').onchange = dirty(box => { stage.particles.points.visible = box.checked; });
    element('showScenery').onchange = dirty(box => stage.setScenery(box.checked));
    element('panelButton').onclick = () => this.showPanel(element('panel').classList.contains('closed'));
    element('help').onclick = () => element('keys').showModal();
  }

  bindChoice(id, action) {
    for (const button of element(id).children)
      button.onclick = () => {
        this.choose(id, button.dataset.value);
        action(button.dataset.value);
        this.player.isDirty = true;
      };
  }

  choose(id, value) {
    for (const button of element(id).children) button.setAttribute('aria-checked', button.dataset.value === value);
  }

  showPanel(isOpen) {
    element('panel').classList.toggle('closed', !isOpen);
    element('panelButton').setAttribute('aria-expanded', isOpen);
    if (isOpen) this.drawGraphs();
  }

  setExplode(share) {
    this.player.explode = share;
    element('explode').value = share;
    element('explodeText').textContent = share > 0 ? `${(1 + share).toFixed(1)}×` : 'off';
  }

  setColouring(mode) {
    this.player.stage.setColouring(mode);
    this.colouring = mode;
    element('scale').hidden = mode < 2;
    this.showRange();
    document.body.dataset.colouring = colouringNames[mode].toLowerCase();
  }

  /** The ends of the scale of colours, over all moments known. */
  showRange() {
    const {ranges} = this.player.stage.pieces.uniforms;
    ranges.value.set(this.fastest, this.coldest, Math.max(this.hottest, this.coldest + 1));
    const isSpeed = this.colouring === 2;
    element('scaleLow').textContent = isSpeed ? '0' : `${Math.round(this.coldest)} K`;
    element('scaleHigh').textContent = isSpeed ? `${shortNumber(this.fastest)} m/s` : `${Math.round(this.hottest)} K`;
  }

  learnRange({poses}) {
    this.player.run.bodies.forEach((body, n) => {
      if (!body.moves || poses.shape[n] < 0) return;
      this.fastest = Math.max(this.fastest, poses.speed[n]);
      this.coldest = Math.min(this.coldest, poses.temperature[n]);
      this.hottest = Math.max(this.hottest, poses.temperature[n]);
    });
    this.showRange();
  }

  bindGraphs() {
    const select = element('graph');
    for (const [name, {title}] of Object.entries(graphs)) select.add(new Option(title, name));
    select.onchange = () => {
      this.graph = select.value;
      this.drawGraphs();
    };
    const canvas = element('graphCanvas');
    const seek = event => {
      if (event.type === 'pointermove' && event.buttons === 0) return;
      const box = canvas.getBoundingClientRect();
      this.player.setPlaying(false);
      this.player.seek(Math.round(((event.clientX - box.left) / box.width) * this.player.lastPlace));
    };
    canvas.onpointerdown = canvas.onpointermove = seek;
  }

  drawGraphs() {
    if (element('panel').classList.contains('closed')) return;
    const graph = graphs[this.graph];
    const now = drawGraph(element('graphCanvas'), graph, this.moments.known, this.moments.count, this.player.frame);
    element('graphUnit').textContent = graph.unit;
    element('legend').innerHTML = Object.entries(now).map(([name, value]) =>
      `<span><i style="background:${colourOfSeries(name)}"></i>${name}<b>${shortNumber(value)}</b></span>`).join('');
  }

  /** What has arrived, along the slider. */
  showLoaded() {
    const {known, count} = this.moments, bars = [];
    for (let n = 0; n < count; ++n) {
      if (!known[n]) continue;
      let end = n;
      while (end + 1 < count && known[end + 1]) ++end;
      bars.push(`<i style="left:${(100 * n) / count}%;width:${(100 * (end + 1 - n)) / count}%"></i>`);
      n = end;
    }
    const done = (100 * this.player.place) / Math.max(this.player.lastPlace, 1);
    element('loaded').innerHTML = `${bars.join('')}<b style="width:${done}%"></b>`;
  }

  show() {
    const {player, moments} = this, {fps, timeScale} = player.run;
    element('time').max = player.lastPlace;
    element('time').value = player.place;
    const done = element('loaded').lastElementChild;
    if (done) done.style.width = `${(100 * player.place) / Math.max(player.lastPlace, 1)}%`;
    if (this.shownFrame === player.frame) return;
    this.shownFrame = player.frame;
    const number = moments.numbers[player.frame] ?? 1, film = (number - 1) / fps;
    element('seconds').textContent = `${(film * timeScale).toFixed(3)} s`;
    element('frame').textContent = `frame ${number} of ${moments.planned}`;
    document.body.dataset.frame = number;
    // The page is drawn by the same processor as the picture where there is no card.
    const now = performance.now();
    if (player.isPlaying && player.stage.isSoftware && now - this.graphsDrawn < 500) return;
    this.graphsDrawn = now;
    this.drawGraphs();
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || element('keys').open) return;
    const {player} = this, typed = event.target instanceof HTMLSelectElement;
    const press = id => element(id).click();
    const choose = (id, value) => element(id).querySelector(`[data-value="${value}"]`).click();
    const faster = by => {
      const select = element('speed');
      select.selectedIndex = Math.max(0, Math.min(select.length - 1, select.selectedIndex + by));
      select.onchange({target: select});
    };
    const actions = {
      ' ': () => player.setPlaying(!player.isPlaying),
      arrowleft: () => player.step(event.shiftKey ? -10 : -1), arrowright: () => player.step(event.shiftKey ? 10 : 1),
      arrowup: () => faster(1), arrowdown: () => faster(-1),
      home: () => player.seek(0), end: () => player.seek(player.lastPlace),
      1: () => choose('colouring', 0), 2: () => choose('colouring', 1), 3: () => choose('colouring', 2), 4: () => choose('colouring', 3),
      x: () => { this.setExplode(player.explode > 0 ? 0 : 1); player.isDirty = true; },
      g: () => press('showGas'), p: () => press('showPoints'), s: () => press('showScenery'),
      c: () => choose('cameraChoice', player.stage.followsFilm ? 'free' : 'film'),
      l: () => this.toggleLoop(), h: () => document.body.classList.toggle('bare'), '?': () => press('help'),
    };
    const action = actions[event.key.toLowerCase()];
    if (!action || (typed && event.key.startsWith('Arrow'))) return;
    event.preventDefault();
    action();
  }
}
