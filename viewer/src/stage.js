// Draws a moment: solid bodies, glass over them, gas between them, and develops the light as the film does.
import {
  BufferAttribute, BufferGeometry, DepthTexture, GLSL3, HalfFloatType, LinearFilter, Matrix4, Mesh, NearestFilter, OrthographicCamera,
  PerspectiveCamera, RawShaderMaterial, Scene, UnsignedIntType, Vector2, Vector3, WebGLRenderer, WebGLRenderTarget,
} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {Gas, heatTexture} from './gas.js';
import {Particles} from './points.js';
import {Pieces} from './pieces.js';
import {blurFragment, developFragment, screenVertex, skyFragment} from './shaders.js';

/** From the most beautiful to the quickest: share of the screen's pixels along an edge, of those for gas, and how many
    cells of gas a step is long. */
const qualities = [
  {screen: 2, gas: 0.5, pace: 0.8}, {screen: 1.5, gas: 0.5, pace: 0.9}, {screen: 1, gas: 0.75, pace: 1},
  {screen: 1, gas: 0.5, pace: 1.2}, {screen: 1, gas: 0.34, pace: 1.4}, {screen: 0.8, gas: 0.3, pace: 1.8},
  {screen: 0.65, gas: 0.3, pace: 2.2}, {screen: 0.5, gas: 0.35, pace: 2.6}, {screen: 0.4, gas: 0.4, pace: 3},
  {screen: 0.33, gas: 0.45, pace: 3},
];
/** From here on edges before gas are not looked after. */
const hasty = 5;
/** No still picture is worse than this. */
const atRest = 7;

const fireColour = new Vector3(0.8, 0.4, 0.15);  // of its light on everything else
const nearest = 0.05, farthest = 200;  // [m] from the camera

export const contextAttributes = {
  alpha: false, antialias: false, depth: false, stencil: false, powerPreference: 'high-performance',
};

const fullScreen = new BufferGeometry()
  .setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));

function pass(fragmentShader, uniforms, options = {}) {
  const material = new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader: screenVertex, fragmentShader, uniforms, depthTest: false, depthWrite: false, ...options,
  });
  const mesh = new Mesh(fullScreen, material);
  mesh.frustumCulled = false;
  return mesh;
}

function layer(options = {}) {
  return new WebGLRenderTarget(8, 8, {
    type: HalfFloatType, minFilter: LinearFilter, magFilter: LinearFilter, ...options,
  });
}

function withDepth(samples) {
  const depthTexture = new DepthTexture(8, 8, UnsignedIntType);
  depthTexture.minFilter = depthTexture.magFilter = NearestFilter;
  return layer({depthTexture, samples});
}

export class Stage {
  /** @param {HTMLCanvasElement} canvas @param {WebGL2RenderingContext} gl @param {object} run its description */
  constructor(canvas, gl, run) {
    this.run = run;
    this.renderer = new WebGLRenderer({canvas, context: gl, ...contextAttributes});
    this.renderer.autoClear = false;
    this.renderer.debug.checkShaderErrors = false;  // asking would wait for the card, program by program
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    this.card = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
    this.isSoftware = /swiftshader|llvmpipe|softpipe|software/i.test(this.card);
    document.body.classList.toggle('hasCard', !this.isSoftware);
    this.quality = this.isSoftware ? 9 : 2;
    this.bestQuality = this.isSoftware ? 3 : 0;
    this.camera = new PerspectiveCamera(40, 1, nearest, farthest);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.followsFilm = true;
    this.isAtRest = false;
    this.flat = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    this.toWorld = new Matrix4();
    this.makeLayers();
    this.makeBodies();
    this.resize();
    // The card begins with these while the pieces are still on their way.
    for (const mesh of [this.sky, this.develop]) this.renderer.compile(mesh, this.flat);
    this.canDrawGas = false;
  }

  makeLayers() {
    const samples = this.isSoftware ? 0 : 4;
    this.solidLayer = withDepth(samples);
    this.glassLayer = withDepth(samples);
    this.halo = [layer({depthBuffer: false}), layer({depthBuffer: false})];
    const {background, exposureStops} = this.run;
    this.skyUniforms = {toWorld: {value: this.toWorld}, eye: {value: new Vector3()}, sky: {value: new Vector3(...background)}};
    this.sky = pass(skyFragment, this.skyUniforms, {depthTest: true});
    this.blurUniforms = {from: {value: null}, fromBehind: {value: null}, texel: {value: new Vector2()}, first: {value: 1}};
    this.blur = pass(blurFragment, this.blurUniforms);
    this.developUniforms = {
      solid: {value: this.solidLayer.texture}, glass: {value: this.glassLayer.texture}, before: {value: null},
      behind: {value: null}, halo: {value: this.halo[0].texture}, halo2: {value: this.halo[1].texture},
      exposure: {value: 2 ** exposureStops}, hasGas: {value: 0}, gasTexel: {value: new Vector2()},
      solidDepth: {value: this.solidLayer.depthTexture}, depthRange: {value: new Vector2(nearest, farthest)},
    };
    this.develop = pass(developFragment, this.developUniforms, {defines: {CAREFUL: 1}});
  }

  makeBodies() {
    const {run} = this, colours = heatTexture(run.heat.colours);
    this.gas = new Gas(run, colours);
    this.gasPass = new Mesh(fullScreen, this.gas.material);
    this.gasPass.frustumCulled = false;
    this.particles = new Particles(colours);
    this.pieces = new Pieces(run.bodies, this.isSoftware);
    this.solids = new Scene();
    this.glasses = new Scene();
    this.sparks = new Scene();
    this.sparks.add(this.particles.points);
    const {uniforms} = this.pieces;
    uniforms.sky.value.set(...run.background);
    uniforms.ambient.value.set(...run.ambient);
    const suns = run.lights.filter(light => light.type === 'sun').slice(0, 2);
    uniforms.sunCount.value = suns.length;
    suns.forEach((sun, n) => {
      uniforms.sunWays.value[n].set(...sun.direction).normalize().negate();
      uniforms.sunLights.value[n].set(...sun.radiance);
    });
    if (suns.length > 0) this.gas.uniforms.sunLight.value.set(...suns[0].radiance).multiplyScalar(0.25);
    this.fireStrength = run.lights.find(light => light.type === 'fire')?.strength ?? 0.5;
    this.lamps = run.lights.filter(light => light.type === 'point').slice(0, 2);
    this.setLamps();
  }

  load(bodies) {
    this.pieces.load(bodies);
    for (const mesh of this.pieces.solids) this.solids.add(mesh);
    for (const mesh of this.pieces.glasses) this.glasses.add(mesh);
    for (const scene of [this.solids, this.glasses]) this.renderer.compile(scene, this.camera);
    this.compileGas();  // after what the first picture waits for
  }

  compileGas() {
    const canWait = this.renderer.extensions.has('KHR_parallel_shader_compile');
    const compiled = mesh => this.renderer[canWait ? 'compileAsync' : 'compile'](mesh, this.flat);
    Promise.all([this.gasPass, this.blur].map(compiled)).then(() => {
      this.canDrawGas = true;
      this.onGas?.();
    });
  }

  setGas(gas) {
    this.gas.set(gas);
    this.setLamps();
  }

  /** The scene's lamps, and the fire as some more. */
  setLamps() {
    const {lamps, lampLights, lampCount} = this.pieces.uniforms;
    this.lamps.forEach((lamp, n) => {
      lamps.value[n].set(...lamp.position, lamp.falloff > 0 ? 2 : 0);
      lampLights.value[n].set(...lamp.intensity);
    });
    this.gas.lights.forEach((light, n) => {
      lamps.value[this.lamps.length + n].set(...light.place, 2);
      lampLights.value[this.lamps.length + n].copy(fireColour).multiplyScalar(light.intensity * this.fireStrength);
    });
    lampCount.value = this.lamps.length + this.gas.lights.length;
  }

  setColouring(mode) {
    this.pieces.setColouring(mode);
    for (const mesh of this.pieces.glasses) (mode > 0 ? this.solids : this.glasses).add(mesh);
  }

  setScenery(isShown) {
    for (const mesh of [...this.pieces.solids, ...this.pieces.glasses])
      if (!mesh.userData.moves) mesh.visible = isShown;
  }

  /** The film's camera, or a step of the one that people turn. */
  placeCamera(key) {
    if (!this.followsFilm || !key) return this.controls.update();
    this.camera.position.set(...key.position);
    this.camera.up.set(...key.up);
    this.controls.target.set(...key.lookAt);
    // On an upright screen the film's width stays in view.
    const wide = Math.tan(key.fov * Math.PI / 360) * (4 / 3);
    const high = Math.max(Math.tan(key.fov * Math.PI / 360), (wide * 0.8) / this.camera.aspect);
    this.camera.fov = Math.atan(high) * 360 / Math.PI;
    this.camera.updateProjectionMatrix();
    this.camera.lookAt(this.controls.target);
    return false;
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.renderer.domElement;
    const {screen, gas, pace} = qualities[this.isAtRest ? Math.min(this.quality, atRest) : this.quality];
    const ratio = screen > 1 ? Math.min(window.devicePixelRatio, screen) : screen;
    const pixels = n => Math.max(8, Math.round(n));
    this.renderer.setPixelRatio(1);
    const w = pixels(width * ratio), h = pixels(height * ratio);
    this.renderer.setSize(w, h, false);
    this.solidLayer.setSize(w, h);
    this.glassLayer.setSize(w, h);
    const [gw, gh] = [pixels(w * gas), pixels(h * gas)];
    this.gas.target.setSize(gw, gh);
    this.halo[0].setSize(pixels(gw / 3), pixels(gh / 3));
    this.halo[1].setSize(pixels(gw / 9), pixels(gh / 9));
    this.gas.uniforms.pace.value = pace;
    const isCareful = this.quality < hasty;
    if (Boolean(this.develop.material.defines.CAREFUL) !== isCareful) {
      this.develop.material.defines = isCareful ? {CAREFUL: 1} : {};
      this.develop.material.needsUpdate = true;
    }
    this.developUniforms.gasTexel.value.set(1 / gw, 1 / gh);
    this.particles.uniforms.size.value = h;
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
  }

  /** A picture that stays may take longer. True when it is drawn otherwise from now on. */
  setAtRest(isAtRest) {
    const isAnother = this.isAtRest !== isAtRest && this.quality > atRest;
    this.isAtRest = isAtRest;
    if (isAnother) this.resize();
    return isAnother;
  }

  changeQuality(by) {
    const next = Math.max(this.bestQuality, Math.min(qualities.length - 1, this.quality + by));
    if (next === this.quality) return false;
    this.quality = next;
    this.resize();
    return true;
  }

  drawInto(target, mesh) {
    this.renderer.setRenderTarget(target);
    this.renderer.render(mesh, this.flat);
  }

  draw(showsGas) {
    const {renderer, camera} = this;
    camera.updateMatrixWorld();
    this.toWorld.copy(camera.matrixWorld).multiply(camera.projectionMatrixInverse);
    this.skyUniforms.eye.value.copy(camera.position);
    this.pieces.uniforms.eye.value.copy(camera.position);
    this.pieces.uniforms.solidDepth.value = null;  // it is drawn into
    renderer.setRenderTarget(this.solidLayer);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.render(this.solids, camera);
    renderer.render(this.sky, this.flat);  // where nothing else is
    renderer.render(this.sparks, camera);
    renderer.setRenderTarget(this.glassLayer);
    renderer.clear();
    this.pieces.uniforms.solidDepth.value = this.solidLayer.depthTexture;
    if (this.glasses.children.length > 0) this.drawGlass();
    const hasGas = showsGas && this.canDrawGas && this.gas.isThere;
    this.developUniforms.hasGas.value = hasGas ? 1 : 0;
    if (hasGas) this.drawGas();
    this.drawInto(null, this.develop);
  }

  /** What stands before solids, nearest pane by nearest pane: panes behind panes are left out. */
  drawGlass() {
    this.renderer.render(this.glasses, this.camera);
  }

  drawGas() {
    const {uniforms, target} = this.gas;
    uniforms.toWorld.value.copy(this.toWorld);
    uniforms.eye.value.copy(this.camera.position);
    uniforms.solidDepth.value = this.solidLayer.depthTexture;
    uniforms.glassDepth.value = this.glassLayer.depthTexture;
    this.drawInto(target, this.gasPass);
    this.developUniforms.before.value = target.textures[0];
    this.developUniforms.behind.value = target.textures[1];
    this.blurUniforms.first.value = 1;
    this.blurUniforms.from.value = target.textures[0];
    this.blurUniforms.fromBehind.value = target.textures[1];
    this.blurUniforms.texel.value.set(1 / target.width, 1 / target.height);
    this.drawInto(this.halo[0], this.blur);
    this.blurUniforms.first.value = 0;
    this.blurUniforms.from.value = this.halo[0].texture;
    this.blurUniforms.texel.value.set(1 / this.halo[0].width, 1 / this.halo[0].height);
    this.drawInto(this.halo[1], this.blur);
  }
}
