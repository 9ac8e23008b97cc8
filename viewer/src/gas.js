// The gas: two 3D textures of the moment, marched along each view ray into a picture smaller than the screen.
import {
  ClampToEdgeWrapping, Data3DTexture, DataTexture, FloatType, GLSL3, HalfFloatType, LinearFilter, Matrix4, NearestFilter,
  RawShaderMaterial, RGBAFormat, RGFormat, UnsignedByteType, Vector3, WebGLRenderTarget,
} from 'three';
import {gasFragment, screenVertex} from './shaders.js';
import {blockCells} from './gas_data.js';

function volumeTexture(bytes, size, format) {
  const texture = new Data3DTexture(bytes, ...size);
  texture.format = format;
  texture.type = UnsignedByteType;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.wrapS = texture.wrapT = texture.wrapR = ClampToEdgeWrapping;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

/** The blackbody's colours, coldest first. */
export function heatTexture(colours) {
  const texture = new DataTexture(Float32Array.from(colours.flatMap(c => [...c, 1])), colours.length, 1, RGBAFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

export class Gas {
  constructor({gas, ambient}, colours) {
    this.optics = gas;
    this.target = new WebGLRenderTarget(8, 8, {
      count: 2, type: HalfFloatType, minFilter: LinearFilter, magFilter: LinearFilter, depthBuffer: false,
    });
    this.uniforms = {
      cells: {value: null}, blocks: {value: null}, colours: {value: colours},
      solidDepth: {value: null}, glassDepth: {value: null},
      toWorld: {value: new Matrix4()}, eye: {value: new Vector3()},
      lower: {value: new Vector3()}, upper: {value: new Vector3()}, blockShare: {value: new Vector3()},
      cell: {value: 1}, pace: {value: 1}, phase: {value: 0},
      opacity: {value: gas.opacity}, minDensity: {value: gas.minDensity}, densityRange: {value: gas.maxDensity - gas.minDensity},
      emission: {value: gas.emission}, smokeColour: {value: new Vector3(...gas.smokeColour)},
      ambient: {value: new Vector3(...ambient)}, sunLight: {value: new Vector3()},
    };
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: screenVertex, fragmentShader: gasFragment, uniforms: this.uniforms,
      depthTest: false, depthWrite: false,
    });
    this.lights = [];
  }

  get isThere() { return this.uniforms.cells.value !== null; }

  /** @param {object | null} gas what the worker made of a moment */
  set(gas) {
    this.uniforms.cells.value?.dispose();
    this.uniforms.blocks.value?.dispose();
    this.uniforms.cells.value = this.uniforms.blocks.value = null;
    this.lights = gas ? gas.lights : [];
    if (!gas) return;
    this.uniforms.cells.value = volumeTexture(gas.cells, gas.size, RGFormat);
    this.uniforms.blocks.value = volumeTexture(gas.blocks, gas.blockSize, RGBAFormat);
    this.uniforms.cell.value = gas.cell;
    const edge = axis => gas.size[axis] * gas.cell, corner = gas.origin.map(o => o - 0.5 * gas.cell);
    this.uniforms.lower.value.set(...corner);
    this.uniforms.upper.value.set(...corner.map((c, axis) => c + edge(axis)));
    this.uniforms.blockShare.value.set(...gas.size.map((n, axis) => n / (blockCells * gas.blockSize[axis])));
  }
}
