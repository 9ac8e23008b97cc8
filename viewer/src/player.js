// The film's time, what of it is on the stage, and how beautifully it can be drawn.

const slowFrame = 48, quickFrame = 22;  // [ms]
const fewFrames = 12;
const restAfter = 500;  // [ms] without a change a picture is a still

export class Player {
  /** @param {import('./stage.js').Stage} stage @param {import('./moments.js').Moments} moments */
  constructor(stage, moments, run, source) {
    Object.assign(this, {stage, moments, run, source});
    this.place = 0;          // in frames from the first
    this.isPlaying = false;
    this.speed = 1;
    this.loops = true;
    this.showsGas = true;
    this.explode = 0;
    this.drawn = {frame: -1, next: -1, gas: -1, asked: -1};
    this.reshaped = new Map();  // frame of the shape by body
    this.isDirty = true;
    this.spans = [];
    this.lastRaise = 0;
    this.moved = 0;          // [ms] when the picture last changed
    this.onFrame = () => {};
    this.longest = 0;        // [ms] between two pictures while playing
    moments.listeners.shown = (frame, message) => this.takeGas(frame, message);
    stage.onGas = () => { this.isDirty = true; };
    stage.controls.addEventListener('change', () => { this.isDirty = true; });
    stage.controls.addEventListener('start', () => this.freeCamera());
    requestAnimationFrame(time => this.tick(time));
  }

  get lastPlace() { return Math.max(this.moments.count - 1, 0); }
  get frame() { return Math.min(Math.floor(this.place + 1e-6), this.lastPlace); }

  freeCamera() {
    if (!this.stage.followsFilm) return;
    this.stage.followsFilm = false;
    this.onCamera?.();
  }

  setPlaying(isPlaying) {
    if (isPlaying && this.place >= this.lastPlace) this.place = 0;
    this.isPlaying = isPlaying && this.lastPlace > 0;
    this.before = undefined;
    this.onPlaying?.();
  }

  seek(place) {
    this.place = Math.min(Math.max(place, 0), this.lastPlace);
    this.moments.want(this.frame);
    this.isDirty = true;
  }

  step(frames) {
    this.setPlaying(false);
    this.seek(this.frame + frames);
  }

  advance(seconds) {
    const to = this.place + seconds * this.run.fps * this.speed;
    // What is not there yet is waited for.
    if (!this.moments.known[Math.min(Math.ceil(to), this.lastPlace)]) return this.moments.want(this.frame);
    this.place = to;
    if (this.place >= this.lastPlace) {
      this.place = this.loops && !this.moments.isGrowing ? 0 : this.lastPlace;
      if (!this.loops) this.setPlaying(false);
    }
    this.isDirty = true;
  }

  takeGas(frame, {gas, points}) {
    this.stage.setGas(gas);
    this.stage.particles.set(points);
    this.drawn.gas = frame;
    this.isDirty = true;
  }

  /** Asks for the gas that will be due when the worker has made it. */
  askForGas() {
    const frame = this.frame;
    if (frame === this.drawn.asked || !this.moments.known[frame]) return;
    this.drawn.asked = frame;
    this.moments.show(frame);
  }

  putPoses() {
    const {known} = this.moments, {pieces} = this.stage;
    const frame = this.frame, moment = known[frame];
    if (!moment) return;
    const next = Math.min(frame + 1, this.lastPlace), following = known[next] ?? moment;
    if (this.drawn.frame !== frame) {
      pieces.setPoses(moment.poses, 0);
      pieces.setMiddle(moment.poses);
      this.drawn.frame = frame;
      this.drawn.next = -1;
      this.reshape(moment.poses.shape);
    }
    if (this.drawn.next !== next && known[next]) {
      pieces.setPoses(following.poses, 1);
      this.drawn.next = next;
    }
    pieces.uniforms.blend.value = known[next] ? this.place - frame : 0;
    pieces.uniforms.explode.value = this.explode;
  }

  /** Fetches the shapes that bodies have in this frame and did not have before it. */
  async reshape(shapes) {
    const wanted = new Set();
    shapes.forEach((shape, body) => {
      if (shape <= 0 && !this.reshaped.has(body)) return;
      if (shape < 0 || this.reshaped.get(body) === shape) return;
      this.reshaped.set(body, shape);
      wanted.add(shape);
    });
    this.shapeBytes ??= new Map();
    for (const shape of wanted) {
      const name = shape > 0 ? `shapes/${shape}.glb` : 'pieces.glb';
      if (!this.shapeBytes.has(name)) this.shapeBytes.set(name, this.source.bytes(name));
      await this.stage.pieces.reshape(await this.shapeBytes.get(name));
      this.isDirty = true;
    }
  }

  /** Fewer pixels when pictures come late, more when they come early for long. */
  adapt(span, now) {
    this.spans.push(span);
    if (this.spans.length < fewFrames) return;
    const middle = this.spans.sort((a, b) => a - b)[fewFrames >> 1];
    this.spans = [];
    if (middle > slowFrame) {
      this.stage.changeQuality(middle > 2.5 * slowFrame ? 2 : 1);
      this.lastRaise = now;
    } else if (middle < quickFrame && now - this.lastRaise > 4000) {
      this.stage.changeQuality(-1);
      this.lastRaise = now;
    }
  }

  tick(now) {
    requestAnimationFrame(time => this.tick(time));
    const span = this.before === undefined ? 0 : now - this.before;
    if (this.isPlaying) this.advance(Math.min(span, 100) / 1000);
    this.before = now;
    const key = this.moments.known[this.frame]?.header.camera;
    const turns = this.stage.placeCamera(key);
    if (this.isDirty || turns) this.moved = now;
    const isAnother = this.stage.setAtRest(!this.isPlaying && now - this.moved > restAfter);
    if (!this.isDirty && !turns && !isAnother) return;
    if (this.isPlaying && span > 0) this.adapt(span, now);
    this.isDirty = false;
    this.putPoses();
    this.askForGas();
    if (!this.moments.known[this.frame]) return;
    this.stage.draw(this.showsGas);
    this.onFrame();
    this.onFirst?.();
    this.onFirst = null;
    if (this.drawn.gas < 0 || !this.stage.canDrawGas) return;
    this.onWhole?.();
    this.onWhole = null;
  }
}
