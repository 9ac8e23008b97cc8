// All moments of the run as far as they are known: poses and numbers of each, gas and particles of the one looked at.
import workerText from 'worker-text';

const atOnce = 3;  // moments on their way

export class Moments {
  /** @param {import('./source.js').Source} source @param {object} run */
  constructor(source, run) {
    this.source = source;
    this.planned = run.planned;
    this.numbers = [];        // frames of the run by their place in the film, as far as they are there
    this.versions = [];       // by place: another is another run's
    this.known = [];          // {header, poses, bytes} by place
    this.asked = new Set();
    this.onWay = 0;
    this.wanted = 0;
    this.bytes = 0;
    this.listeners = {arrived: () => {}, shown: () => {}, trouble: () => {}};
    this.worker = new Worker(URL.createObjectURL(new Blob([workerText], {type: 'text/javascript'})));
    this.worker.onmessage = event => this.hear(event.data);
    const sun = run.lights.find(light => light.type === 'sun');
    this.worker.postMessage({kind: 'optics', optics: {gas: run.gas, heat: run.heat, sun: sun ? sun.direction.map(d => -d) : null}});
    this.showing = null;      // asked of the worker
    this.next = null;         // to be asked when that is done
  }

  get count() { return this.numbers.length; }
  get isGrowing() { return this.count < this.planned; }

  /** What the run says is there. */
  grow(state) {
    this.planned = state.planned;
    const before = this.count;
    this.numbers = state.numbers ?? Array.from({length: state.frames}, (_, n) => n + 1);
    // Another run took its place.
    if (this.count < before || this.versions.some((version, place) => version !== state.versions?.[place])) location.reload();
    this.versions = state.versions ?? [];
    this.fetchMore();
    return this.count > before;
  }

  /** Moments come from where the film is looked at on. */
  want(place) {
    this.wanted = place;
    this.fetchMore();
  }

  nextMissing() {
    for (let n = 0; n < this.count; ++n) {
      const place = (this.wanted + n) % this.count;
      if (!this.asked.has(place)) return place;
    }
    return -1;
  }

  fetchMore() {
    for (let place; this.onWay < atOnce && (place = this.nextMissing()) >= 0;) this.fetch(place);
  }

  async fetch(place) {
    this.asked.add(place);
    ++this.onWay;
    try {
      const bytes = await this.source.bytes(`moments/${this.numbers[place]}`);
      this.bytes += bytes.length;
      this.worker.postMessage({kind: 'arrive', frame: place, bytes}, [bytes.buffer]);
    } catch (trouble) {
      setTimeout(() => this.asked.delete(place), 2000);  // and again
      this.listeners.trouble(trouble.message);
    }
    --this.onWay;
    this.fetchMore();
  }

  /** Gas and particles of a moment; of requests that come too fast only the last counts. */
  show(place) {
    if (!this.known[place]) return;
    if (this.showing === null) {
      this.showing = place;
      this.worker.postMessage({kind: 'show', frame: place});
    } else {
      this.next = place;
    }
  }

  hear(message) {
    if (message.kind === 'arrived') {
      this.known[message.frame] = message;
      this.listeners.arrived(message.frame, message);
    } else if (message.kind === 'shown') {
      this.showing = null;
      if (this.next !== null) {
        const next = this.next;
        this.next = null;
        this.show(next);
      }
      this.listeners.shown(message.frame, message);
    } else {
      this.showing = null;
      this.listeners.trouble(message.text);
    }
  }
}
